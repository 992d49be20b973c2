#include "assembly.h"

#include <algorithm>

namespace bench {
namespace {

using handles::check;

mlcp_matrix_view view_of(mlcp_status (*get)(const mlcp_problem*, mlcp_matrix_view*), const mlcp_problem* problem) {
  mlcp_matrix_view view;
  mlcp_matrix_view_init(&view, sizeof view);
  check(get(problem, &view));
  return view;
}

std::int32_t length(const auto& array) { return static_cast<std::int32_t>(array.size()); }

}  // namespace

Assembly::Assembly(const mlcp_problem* problem, std::int32_t facets) {
  const std::vector<Velocity> velocity = take_bodies(problem);
  rows_ = PlainRows(problem, velocity, facets);
  take_compliance(problem);
}

std::vector<Velocity> Assembly::take_bodies(const mlcp_problem* problem) {
  const std::int32_t n = mlcp_problem_velocity_count(problem);
  const mlcp_matrix_view mass = view_of(mlcp_problem_mass, problem);
  std::vector<double> k(static_cast<std::size_t>(n));
  check(mlcp_problem_get_momentum(problem, n, k.data()));
  std::vector<std::int32_t> ids(static_cast<std::size_t>(mlcp_problem_body_count(problem)));
  std::int32_t count = 0;
  check(mlcp_problem_bodies(problem, length(ids), ids.data(), &count));
  std::vector<Velocity> velocity(k.size());
  std::vector<double> given;
  for (const std::int32_t id : ids) {
    std::int32_t offset = 0, prescribed = 0;
    Body body{0, false, mass_.size(), {0}, {}};
    check(mlcp_problem_body_range(problem, id, &offset, &body.dimension));
    given.resize(static_cast<std::size_t>(body.dimension));
    check(mlcp_problem_body_state(problem, id, &prescribed, body.dimension, given.data()));
    for (std::int32_t j = 0; j < body.dimension; ++j) velocity[offset + j] = {prescribed ? -1 : length(k_) + j, given[j]};
    if (prescribed) continue;
    k_.insert(k_.end(), k.begin() + offset, k.begin() + offset + body.dimension);
    std::vector<std::pair<std::int32_t, double>> column;
    for (std::int32_t j = offset; j < offset + body.dimension; ++j) {
      column.clear();
      for (std::int32_t e = mass.pointers[j]; e < mass.pointers[j + 1]; ++e) column.emplace_back(mass.indices[e] - offset, mass.values[e]);
      std::sort(column.begin(), column.end());
      for (const auto& [i, value] : column) {
        body.indices.push_back(i);
        mass_.push_back(value);
      }
      body.pointers.push_back(length(body.indices));
    }
    body.dense = body.indices.size() == static_cast<std::size_t>(body.dimension) * static_cast<std::size_t>(body.dimension);
    if (body.dense) {
      body.pointers.clear();
      body.indices.clear();
    }
    bodies_.push_back(std::move(body));
  }
  return velocity;
}

/// Σ where it is not diagonal.
void Assembly::take_compliance(const mlcp_problem* problem) {
  const mlcp_matrix_view sigma = view_of(mlcp_problem_compliance, problem);
  std::vector<std::int32_t> number(static_cast<std::size_t>(sigma.columns), -1);
  for (std::int32_t i = 0; i < length(rows_.source); ++i)
    if (rows_.source[i] >= 0) number[rows_.source[i]] = i;
  bool diagonal = true;
  const auto add = [&](std::int32_t i, std::int32_t j, double value) {
    diagonal &= i == j;
    sigma_indices_.push_back(i);
    sigma_.push_back(value);
  };
  auto block = rows_.compliant.begin();
  sigma_pointers_.push_back(0);
  for (std::int32_t j = 0; j < length(rows_.source); ++j) {
    while (block != rows_.compliant.end() && j >= block->first + block->count) ++block;
    if (const std::int32_t row = rows_.source[j]; row >= 0) {
      for (std::int32_t e = sigma.pointers[row]; e < sigma.pointers[row + 1]; ++e)
        if (number[sigma.indices[e]] >= 0) add(number[sigma.indices[e]], j, sigma.values[e]);
    } else if (block != rows_.compliant.end() && j >= block->first) {
      for (std::int32_t k = 0; k < block->count; ++k) add(block->first + k, j, block->sigma[static_cast<std::size_t>(k * block->count + j - block->first)]);
    } else {
      add(j, j, 0);
    }
    sigma_pointers_.push_back(length(sigma_indices_));
  }
  if (!diagonal) return;
  sigma_pointers_.clear();
  sigma_indices_.clear();
  sigma_.clear();
}

void Assembly::append(const Assembly& other, std::uint64_t which) {
  if (!sigma_.empty() || !other.sigma_.empty()) throw std::runtime_error("only problems with a diagonal compliance go side by side");
  const std::int32_t n = length(k_), entries = length(rows_.columns);
  for (Body body : other.bodies_) {
    body.first += mass_.size();
    bodies_.push_back(std::move(body));
  }
  for (const std::int32_t column : other.rows_.columns) rows_.columns.push_back(n + column);
  for (std::size_t i = 1; i < other.rows_.pointers.size(); ++i) rows_.pointers.push_back(entries + other.rows_.pointers[i]);
  for (const std::uint64_t key : other.rows_.key) rows_.key.push_back(key == 0 ? 0 : key ^ (which * 0x9e3779b97f4a7c15u));
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(mass_, other.mass_);
  join(k_, other.k_);
  join(rows_.values, other.rows_.values);
  join(rows_.r, other.rows_.r);
  join(rows_.lo, other.rows_.lo);
  join(rows_.hi, other.rows_.hi);
  join(rows_.compliance, other.rows_.compliance);
  join(rows_.source, other.rows_.source);
}

void Assembly::share_mass_pattern(std::span<Assembly> steps) {
  if (steps.empty()) return;
  Assembly all = steps.front();
  for (std::size_t b = 0; b < all.bodies_.size(); ++b) {
    Body& body = all.bodies_[b];
    for (const Assembly& step : steps) {
      if (step.bodies_.size() != all.bodies_.size() || step.bodies_[b].dimension != body.dimension)
        throw std::runtime_error("the steps of a sequence have different bodies");
      body.dense |= step.bodies_[b].dense;
    }
    if (body.dense) {
      body.pointers.clear();
      body.indices.clear();
      continue;
    }
    std::vector<std::int32_t> column;
    body.indices.clear();
    for (std::size_t j = 0; j < static_cast<std::size_t>(body.dimension); ++j) {
      column.clear();
      for (const Assembly& step : steps) {
        const Body& other = step.bodies_[b];
        column.insert(column.end(), other.indices.begin() + other.pointers[j], other.indices.begin() + other.pointers[j + 1]);
      }
      std::sort(column.begin(), column.end());
      column.erase(std::unique(column.begin(), column.end()), column.end());
      body.indices.insert(body.indices.end(), column.begin(), column.end());
      body.pointers[j + 1] = length(body.indices);
    }
  }
  for (Assembly& step : steps) step.spread_mass(all);
}

/// M in a larger pattern.
void Assembly::spread_mass(const Assembly& pattern) {
  std::vector<double> mass, column;
  std::vector<Body> bodies = pattern.bodies_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& to = bodies[b];
    const Body& from = bodies_[b];
    to.first = mass.size();
    for (std::size_t j = 0; j < static_cast<std::size_t>(from.dimension); ++j) {
      const auto d = static_cast<std::size_t>(from.dimension);
      column.assign(d, 0.0);
      if (from.dense)
        std::copy_n(mass_.begin() + static_cast<std::ptrdiff_t>(from.first + j * d), d, column.begin());
      else
        for (std::int32_t e = from.pointers[j]; e < from.pointers[j + 1]; ++e) column[from.indices[e]] = mass_[from.first + e];
      if (to.dense)
        mass.insert(mass.end(), column.begin(), column.end());
      else
        for (std::int32_t e = to.pointers[j]; e < to.pointers[j + 1]; ++e) mass.push_back(column[to.indices[e]]);
    }
  }
  bodies_ = std::move(bodies);
  mass_ = std::move(mass);
}

handles::Problem Assembly::build(const mlcp_allocator* allocator) const {
  mlcp_problem* made = nullptr;
  check(mlcp_problem_create(allocator, &made));
  handles::Problem problem(made);
  for (std::size_t b = 0; b < bodies_.size();) {
    const Body& body = bodies_[b];
    std::size_t next = b + 1;
    if (body.dense) {  // a run of equal dimension goes in one call
      while (next < bodies_.size() && bodies_[next].dense && bodies_[next].dimension == body.dimension) ++next;
      const auto count = static_cast<std::int32_t>(next - b);
      check(mlcp_problem_bodies_add(problem.get(), count, body.dimension, mass_.data() + body.first, 0, nullptr), problem);
    } else {
      check(mlcp_problem_body_add_sparse(problem.get(), body.dimension, body.pointers.data(), body.indices.data(),
                                         mass_.data() + body.first, MLCP_FULL, nullptr), problem);
    }
    b = next;
  }
  check(mlcp_problem_set_momentum(problem.get(), 0, length(k_), k_.data()), problem);
  add_rows(problem);
  return problem;
}

void Assembly::step(const handles::Problem& problem) const {
  set_masses(problem);
  check(mlcp_problem_set_momentum(problem.get(), 0, length(k_), k_.data()), problem);
  check(mlcp_problem_rows_clear(problem.get()), problem);
  add_rows(problem);
}

void Assembly::add_rows(const handles::Problem& problem) const {
  const std::int32_t m = length(rows_.r);
  check(mlcp_problem_rows_add_csr(problem.get(), m, rows_.pointers.data(), rows_.columns.data(), rows_.values.data(), rows_.r.data(), rows_.lo.data(),
                                  rows_.hi.data(), sigma_.empty() ? rows_.compliance.data() : nullptr, rows_.key.data(), nullptr), problem);
  if (!sigma_.empty()) set_sigma(problem);
}

void Assembly::set_masses(const handles::Problem& problem) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    check(mlcp_problem_body_set_mass(problem.get(), static_cast<std::int32_t>(b), mass_.data() + bodies_[b].first,
                                     static_cast<std::int64_t>(bodies_[b].entries())), problem);
}

void Assembly::refresh(const handles::Problem& problem) const {
  set_masses(problem);
  check(mlcp_problem_set_momentum(problem.get(), 0, length(k_), k_.data()), problem);
  for (std::size_t i = 0; i < rows_.r.size(); ++i) {
    const std::int32_t first = rows_.pointers[i], count = rows_.pointers[i + 1] - first;
    check(mlcp_problem_row_set_jacobian(problem.get(), static_cast<std::int32_t>(i), rows_.values.data() + first, count), problem);
  }
  check(mlcp_problem_rows_set_r(problem.get(), 0, length(rows_.r), rows_.r.data()), problem);
  if (sigma_.empty())
    check(mlcp_problem_rows_set_compliance(problem.get(), 0, length(rows_.compliance), rows_.compliance.data()), problem);
  else
    set_sigma(problem);
}

void Assembly::set_sigma(const handles::Problem& problem) const {
  check(mlcp_problem_set_compliance_matrix(problem.get(), length(rows_.r), sigma_pointers_.data(), sigma_indices_.data(), sigma_.data(),
                                           MLCP_FULL),
        problem);
}

}  // namespace bench
