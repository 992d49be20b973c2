#include "scene.h"

#include <algorithm>
#include <utility>

namespace scenes {

Scene::Scene(std::int32_t dimension, std::span<const double> masses, std::int32_t rows_of_contact)
    : dimension_(dimension), rows_of_contact_(rows_of_contact), problem_(make_problem()), solver_(make_solver()), start_(make_mask()) {
  const auto count = static_cast<std::int32_t>(masses.size() / static_cast<std::size_t>(dimension * dimension));
  check(mlcp_problem_bodies_add(problem_.get(), count, dimension, masses.data(), 0, nullptr), problem_);
  velocity_.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(dimension));
  force_.resize(velocity_.size());
  mlcp_report_init(&report_, sizeof report_);
}

void Scene::prepare(double h) {
  h_ = h;
  std::fill(force_.begin(), force_.end(), 0.0);
  add_forces(force_);
  check(mlcp_timestep_momentum(problem_.get(), h, static_cast<std::int32_t>(velocity_.size()), velocity_.data(), force_.data()),
        problem_);
  check(mlcp_problem_rows_clear(problem_.get()), problem_);
  listed_rows().add_to(problem_, h, stabilisation);
  listed_contacts().add_to(problem_, h, stabilisation, law_, velocity_);
  if (!stepped_) return;
  const mlcp_mask* previous = nullptr;
  check(mlcp_solver_mask(solver_.get(), &previous));
  check(mlcp_mask_carry(start_.get(), problem_.get(), previous, MLCP_ROW_AT_LOWER), start_);
}

const mlcp_report& Scene::finish() {
  check(mlcp_solve(solver_.get(), problem_.get(), nullptr, start(), &report_), solver_);
  const double* v = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_velocities(solver_.get(), &v, &count));
  velocity_.assign(v, v + count);
  advance(h_, velocity_);
  time_ += h_;
  stepped_ = true;
  return report_;
}

const mlcp_report& Scene::step(double h) {
  prepare(h);
  return finish();
}

void Scene::use(const mlcp_settings& settings) { check(mlcp_solver_set_settings(solver_.get(), &settings), solver_); }

RowList Scene::listed_rows() const {
  RowList rows(dimension_);
  add_rows(rows);
  return rows;
}

ContactList Scene::listed_contacts() const {
  ContactList contacts(dimension_, rows_of_contact_);
  add_contacts(contacts);
  return contacts;
}

Scene::Violation Scene::violation() const {
  const RowList rows = listed_rows();
  const ContactList contacts = listed_contacts();
  Violation violation = {rows.deepest(), rows.drift()};
  for (const double gap : contacts.gaps()) violation.penetration = std::max(violation.penetration, -gap);
  return violation;
}

double Scene::energy() const {
  mlcp_matrix_view mass;
  mlcp_matrix_view_init(&mass, sizeof mass);
  check(mlcp_problem_mass(problem_.get(), &mass));
  double twice = 0;
  for (std::size_t column = 0; column < velocity_.size(); ++column)
    for (std::int32_t entry = mass.pointers[column]; entry < mass.pointers[column + 1]; ++entry)
      twice += velocity_[static_cast<std::size_t>(mass.indices[entry])] * mass.values[entry] * velocity_[column];
  return 0.5 * twice + potential_energy();
}

Problem Scene::problem_of_step(Scene&& scene, double h) {
  scene.prepare(h);
  return std::move(scene.problem_);
}

void Scene::set_mass(std::int32_t body, std::span<const double> mass) {
  check(mlcp_problem_body_set_mass(problem_.get(), body, mass.data(), static_cast<std::int64_t>(mass.size())), problem_);
}

std::span<double> Scene::velocity(std::int32_t body) {
  const auto dimension = static_cast<std::size_t>(dimension_);
  return std::span(velocity_).subspan(static_cast<std::size_t>(body) * dimension, dimension);
}

void Scene::prescribe(std::int32_t body, std::span<const double> velocity) {
  check(mlcp_problem_body_set_prescribed(problem_.get(), body, velocity.data(), static_cast<std::int32_t>(velocity.size())), problem_);
  std::copy(velocity.begin(), velocity.end(), this->velocity(body).begin());
}

}  // namespace scenes
