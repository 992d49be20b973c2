#include "analyze/quotient_graph.h"

#include "analyze/union_find.h"

namespace mlcp {
namespace {

/// Connected parts of M of at most this many velocities become elements: their own factor is at most this dense triangle.
constexpr std::int32_t small_part = 12;

/// Connected components of M over the selected velocities: component[j] = smallest velocity of j's component.
void mass_components(const Problem& problem, const Selection& selection, Array<std::int32_t>& component) {
  const SparseView mass = problem.mass_view();
  start_sets(component, problem.n());
  for (std::int32_t j = 0; j < problem.n(); ++j) {
    if (!selection.velocity[j]) continue;
    for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t) join(component, j, mass.indices[t]);
  }
  for (std::int32_t j = 0; j < problem.n(); ++j) component[j] = root_of(component, j);
}

}  // namespace

void QuotientGraph::build(const Problem& problem, const Selection& selection, const Crowding& crowding) {
  const std::int32_t n = problem.n(), m = problem.m();
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  mass_components(problem, selection, component);
  count.assign(n, 0);
  for (std::int32_t j = 0; j < n; ++j) ++count[component[j]];

  element_of.assign(n, -1);
  variable_of.assign(n + m, -1);
  node.clear();
  elements = 0;
  for (std::int32_t j = 0; j < n; ++j) {
    if (!selection.velocity[j]) continue;
    if (count[component[j]] <= small_part && !crowding.crowded[j]) {
      element_of[j] = component[j] == j ? elements++ : element_of[component[j]];
    } else {
      variable_of[j] = static_cast<std::int32_t>(node.size());
      node.push_back(j);
    }
  }
  const auto velocities = static_cast<std::int32_t>(node.size());
  for (std::int32_t i = 0; i < m; ++i) {
    if (!selection.row[i]) continue;
    variable_of[n + i] = static_cast<std::int32_t>(node.size());
    node.push_back(n + i);
  }
  variables = static_cast<std::int32_t>(node.size());
  waits.assign(variables, 0);
  for (std::int32_t x = velocities; x < variables; ++x) waits[x] = !crowding.crowded[node[x]];

  // variable → elements, and velocity variable → rows; the marks keep one entry each
  scratch.assign(elements, -1);
  variable_pointers.assign(variables + 1, 0);
  variable_elements.clear();
  own_pointers.assign(velocities + 1, 0);
  for (std::int32_t x = 0; x < variables; ++x) {
    if (node[x] >= n) {
      const std::int32_t i = node[x] - n;
      for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t) {
        const std::int32_t j = jacobian.indices[t], e = element_of[j];
        if (e >= 0 && scratch[e] != x) {
          scratch[e] = x;
          variable_elements.push_back(e);
        }
        if (variable_of[j] >= 0) ++own_pointers[variable_of[j] + 1];
      }
    }
    variable_pointers[x + 1] = static_cast<std::int32_t>(variable_elements.size());
  }
  element_pointers.assign(elements + 1, 0);
  for (const std::int32_t e : variable_elements) ++element_pointers[e + 1];
  for (std::int32_t e = 0; e < elements; ++e) element_pointers[e + 1] += element_pointers[e];
  element_variables.resize(variable_elements.size());
  count.assign(element_pointers.span().first(elements));
  for (std::int32_t x = 0; x < variables; ++x)
    for (std::int32_t t = variable_pointers[x]; t < variable_pointers[x + 1]; ++t)
      element_variables[count[variable_elements[t]]++] = x;

  for (std::int32_t x = 0; x < velocities; ++x) own_pointers[x + 1] += own_pointers[x];
  own_rows.resize(own_pointers[velocities]);
  count.assign(own_pointers.span().first(velocities));
  for (std::int32_t x = velocities; x < variables; ++x) {
    const std::int32_t i = node[x] - n;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
      if (const std::int32_t y = variable_of[jacobian.indices[t]]; y >= 0) own_rows[count[y]++] = x;
  }

  // neighbours: M among velocity variables, J between them and rows, Σ among rows
  neighbour_pointers.assign(variables + 1, 0);
  neighbours.clear();
  for (std::int32_t x = 0; x < variables; ++x) {
    if (const std::int32_t j = node[x]; j < n) {
      for (std::int32_t t = mass.pointers[j]; t < mass.pointers[j + 1]; ++t)
        if (mass.indices[t] != j) neighbours.push_back(variable_of[mass.indices[t]]);
      for (std::int32_t t = own_pointers[x]; t < own_pointers[x + 1]; ++t) neighbours.push_back(own_rows[t]);
    } else {
      const std::int32_t i = node[x] - n;
      for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
        if (const std::int32_t y = variable_of[jacobian.indices[t]]; y >= 0) neighbours.push_back(y);
      for (std::int32_t t = sigma.pointers[i]; t < sigma.pointers[i + 1]; ++t)
        if (const std::int32_t y = variable_of[n + sigma.indices[t]]; y >= 0 && y != x) neighbours.push_back(y);
    }
    neighbour_pointers[x + 1] = static_cast<std::int32_t>(neighbours.size());
  }
}

}  // namespace mlcp
