#include "contact_list.h"

#include <algorithm>

namespace scenes {

void ContactList::add(std::int32_t body_a, std::int32_t body_b, std::span<const double> jacobian_a, std::span<const double> jacobian_b,
                      std::span<const Point> directions, const ContactPoint& at, const Material& material) {
  jacobian_.insert(jacobian_.end(), jacobian_a.begin(), jacobian_a.end());
  jacobian_.insert(jacobian_.end(), jacobian_b.begin(), jacobian_b.end());
  body_a_.push_back(body_a);
  body_b_.push_back(body_b);
  gap_.push_back(at.gap);
  friction_.push_back(material.friction);
  restitution_.push_back(material.restitution);
  stiffness_.push_back(material.stiffness);
  for (const Point& direction : directions) actions_.push_back({at.point, direction});
  key_.push_back(row_key(body_a, body_b, at.feature));
}

double ContactList::approach(std::size_t contact, std::span<const double> v) const {
  const auto dimension = static_cast<std::size_t>(dimension_), rows = static_cast<std::size_t>(rows_);
  double sum = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::int32_t body = (side == 0 ? body_a_ : body_b_)[contact];
    if (body == MLCP_WORLD) continue;
    const double* row = jacobian_.data() + (2 * contact + side) * rows * dimension;
    const auto of_body = v.subspan(static_cast<std::size_t>(body) * dimension, dimension);
    for (std::size_t i = 0; i < dimension; ++i) sum += row[i] * of_body[i];
  }
  return sum;
}

void ContactList::add_to(const Problem& problem, double h, double stabilisation, const FrictionLaw& law, std::span<const double> v) const {
  if (gap_.empty()) return;
  std::vector<double> r(gap_.size() * static_cast<std::size_t>(rows_)), compliance(r.size());
  std::vector<mlcp_friction> models(gap_.size(), law.model);
  const std::vector<std::int32_t> facets(gap_.size(), law.facets);
  for (std::size_t i = 0; i < gap_.size(); ++i) {
    const std::size_t row = i * static_cast<std::size_t>(rows_);
    double& normal = r[row];
    if (std::isfinite(stiffness_[i])) {
      check(mlcp_timestep_spring(h, stiffness_[i], 0, gap_[i], &compliance[row], &normal));
      std::fill_n(&compliance[row + 1], rows_ - 1, compliance[row]);
    } else {
      check(mlcp_timestep_rows(h, stabilisation, true, 1, &gap_[i], nullptr, &normal));
    }
    if (friction_[i] == 0) models[i] = MLCP_FRICTION_NONE;
    if (restitution_[i] == 0) continue;
    const double rate = approach(i, v);
    check(mlcp_timestep_restitution(h, slow, 1, &restitution_[i], &gap_[i], &rate, nullptr, &normal));
  }
  mlcp_contacts contacts;
  mlcp_contacts_init(&contacts, sizeof contacts);
  contacts.count = count();
  contacts.dimension = rows_;
  contacts.body_a = body_a_.data();
  contacts.body_b = body_b_.data();
  contacts.jacobian_a = jacobian_.data();
  contacts.jacobian_b = jacobian_.data() + rows_ * dimension_;
  contacts.jacobian_a_stride = contacts.jacobian_b_stride = 2 * rows_ * dimension_ * static_cast<std::ptrdiff_t>(sizeof(double));
  contacts.r = r.data();
  contacts.compliance = compliance.data();
  contacts.mu = friction_.data();
  contacts.model = models.data();
  contacts.facets = facets.data();
  contacts.key = key_.data();
  check(mlcp_problem_contacts_add(problem.get(), &contacts, nullptr), problem);
}

void ContactList::draw(Drawing& to) const { to.actions.insert(to.actions.end(), actions_.begin(), actions_.end()); }

}  // namespace scenes
