#include "analyze/quotient_graph.h"

#include <algorithm>

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

/// The variable that row i of a crowded island may go with, −1.
std::int32_t QuotientGraph::leader_of(const Problem& problem, std::int32_t i) const {
  const std::int32_t n = problem.n();
  const SparseView jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  const auto alone = [&](std::int32_t row) {
    for (std::int32_t t = sigma.pointers[row]; t < sigma.pointers[row + 1]; ++t)
      if (sigma.indices[t] != row) return false;
    return true;
  };
  if (!alone(i)) return -1;
  const auto columns = [&](std::int32_t row) { return std::span(jacobian.indices + jacobian.pointers[row], jacobian.indices + jacobian.pointers[row + 1]); };
  std::int32_t count_of_dynamic = 0, velocity = -1;
  for (const std::int32_t j : columns(i))
    if (variable_of[j] >= 0) velocity = variable_of[j], ++count_of_dynamic;
  if (count_of_dynamic == 1) return velocity;
  const std::int32_t last = node.back();
  return last >= n && std::ranges::equal(columns(last - n), columns(i)) && alone(last - n) ? variable_of[last] : -1;
}

/// What is a variable and what an element, and their numbers.
void QuotientGraph::number(const Problem& problem, const Selection& selection, const Crowding& crowding) {
  const std::int32_t n = problem.n(), m = problem.m();
  mass_components(problem, selection, component);
  count.assign(n, 0);
  for (std::int32_t j = 0; j < n; ++j) ++count[component[j]];

  element_of.assign(n, -1);
  variable_of.assign(n + m, -1);
  node.clear();
  weight.clear();
  leader.assign(m, -1);
  elements = 0;
  const auto add_variable = [this](std::int32_t x) {
    variable_of[x] = static_cast<std::int32_t>(node.size());
    node.push_back(x);
    weight.push_back(1);
  };
  for (std::int32_t j = 0; j < n; ++j) {
    if (!selection.velocity[j]) continue;
    if (count[component[j]] <= small_part && !crowding.crowded[j])
      element_of[j] = component[j] == j ? elements++ : element_of[component[j]];
    else
      add_variable(j);
  }
  velocities_ = static_cast<std::int32_t>(node.size());
  for (std::int32_t i = 0; i < m; ++i) {
    if (!selection.row[i]) continue;
    if (crowding.crowded[n + i]) leader[i] = leader_of(problem, i);
    if (leader[i] < 0) add_variable(n + i);
    else if (leader[i] >= velocities_) ++weight[leader[i]];
  }
  variables = static_cast<std::int32_t>(node.size());
  waits.assign(variables, 0);
  for (std::int32_t x = velocities_; x < variables; ++x) waits[x] = !crowding.crowded[node[x]];
}

/// Variables → elements, and back.
void QuotientGraph::join_elements(const Problem& problem) {
  const std::int32_t n = problem.n();
  const SparseView jacobian = problem.jacobian_view();
  variable_pointers.assign(variables + 1, 0);
  variable_elements.clear();
  scratch.assign(elements, -1);  // each element once a row
  for (std::int32_t x = velocities_; x < variables; ++x) {
    const std::int32_t i = node[x] - n;
    for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
      if (const std::int32_t e = element_of[jacobian.indices[t]]; e >= 0 && scratch[e] != x) {
        scratch[e] = x;
        variable_elements.push_back(e);
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
}

/// Variables beside each other: M among velocities, J between them and rows, Σ among rows.
void QuotientGraph::join_variables(const Problem& problem) {
  const std::int32_t n = problem.n();
  const SparseView mass = problem.mass_view(), jacobian = problem.jacobian_view(), sigma = problem.compliance_view();
  const auto for_each_own = [&](auto visit) {
    for (std::int32_t x = velocities_; x < variables; ++x) {
      const std::int32_t i = node[x] - n;
      for (std::int32_t t = jacobian.pointers[i]; t < jacobian.pointers[i + 1]; ++t)
        if (const std::int32_t y = variable_of[jacobian.indices[t]]; y >= 0) visit(y, x);
    }
  };
  own_pointers.assign(velocities_ + 1, 0);
  for_each_own([&](std::int32_t y, std::int32_t) { ++own_pointers[y + 1]; });
  for (std::int32_t x = 0; x < velocities_; ++x) own_pointers[x + 1] += own_pointers[x];
  own_rows.resize(own_pointers[velocities_]);
  count.assign(own_pointers.span().first(velocities_));
  for_each_own([&](std::int32_t y, std::int32_t x) { own_rows[count[y]++] = x; });

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

void QuotientGraph::build(const Problem& problem, const Selection& selection, const Crowding& crowding) {
  number(problem, selection, crowding);
  join_elements(problem);
  join_variables(problem);
}

}  // namespace mlcp
