#include "support/build.h"

#include <sstream>

#include "assemble/bodies.h"
#include "assemble/compliance.h"
#include "assemble/rows.h"

namespace support {
namespace {

struct Columns {
  std::vector<std::int32_t> pointers{0}, rows;
  std::vector<double> values;
};

Columns compress(const Eigen::MatrixXd& a) {
  Columns c;
  for (int j = 0; j < a.cols(); ++j) {
    for (int i = 0; i < a.rows(); ++i) {
      if (a(i, j) == 0 && i != j) continue;
      c.rows.push_back(i);
      c.values.push_back(a(i, j));
    }
    c.pointers.push_back(static_cast<std::int32_t>(c.rows.size()));
  }
  return c;
}

void print(std::ostream& out, const char* name, const mlcp::SparseView& a) {
  out << name << " (outer: inner value ...)\n";
  for (std::int32_t j = 0; j < a.outer; ++j) {
    out << "  " << j << ":";
    for (std::int32_t t = a.pointers[j]; t < a.pointers[j + 1]; ++t) out << "  " << a.indices[t] << ' ' << a.values[t];
    out << '\n';
  }
}

void print(std::ostream& out, const char* name, const mlcp::Mask* mask) {
  if (!mask) return;
  out << name;
  for (const mlcp_row_state s : mask->state) out << ' ' << int(s);
  out << '\n';
}

}  // namespace

mlcp::Problem empty_problem() { return mlcp::Problem(mlcp::Memory()); }

int add_body(mlcp::Problem& problem, const Eigen::MatrixXd& mass) {
  std::int32_t id = -1;
  mlcp::bodies_add(problem, 1, static_cast<std::int32_t>(mass.rows()), mass.data(), 0, &id);
  return id;
}

int add_body(mlcp::Problem& problem, int dimension, double mass) {
  return add_body(problem, Eigen::MatrixXd(mass * Eigen::MatrixXd::Identity(dimension, dimension)));
}

int add_sparse_body(mlcp::Problem& problem, const Eigen::MatrixXd& mass) {
  const Columns c = compress(mass);
  return mlcp::body_add_sparse(problem, static_cast<std::int32_t>(mass.rows()), c.pointers.data(), c.rows.data(), c.values.data(),
                               MLCP_FULL);
}

void prescribe(mlcp::Problem& problem, int body, std::vector<double> velocity) {
  mlcp::body_set_prescribed(problem, body, velocity.data(), static_cast<std::int32_t>(velocity.size()));
}

void set_k(mlcp::Problem& problem, const Eigen::VectorXd& k) {
  mlcp::set_momentum(problem, 0, static_cast<std::int32_t>(k.size()), k.data());
}

int add_row(mlcp::Problem& problem, const std::vector<Entry>& entries, double r, Bounds bounds, double compliance,
            std::uint64_t key) {
  std::vector<std::int32_t> columns;
  std::vector<double> values;
  for (const Entry& e : entries) {
    columns.push_back(e.column);
    values.push_back(e.value);
  }
  return mlcp::row_add(problem, static_cast<std::int32_t>(entries.size()), columns.data(), values.data(), r, bounds.lo, bounds.hi,
                       compliance, key);
}

void set_sigma(mlcp::Problem& problem, const Eigen::MatrixXd& sigma) {
  const Columns c = compress(sigma);
  const auto size = static_cast<std::int32_t>(sigma.rows());
  mlcp::set_compliance_matrix(problem, {size, c.pointers.data(), c.rows.data(), c.values.data(), MLCP_FULL});
}

mlcp::Mask mask_of(const std::vector<mlcp_row_state>& states) {
  mlcp::Mask mask{mlcp::Memory()};
  mask.state.assign(std::span<const mlcp_row_state>(states));
  return mask;
}

mlcp::Problem reduced_problem(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  mlcp::Problem problem = empty_problem();
  for (int i = 0; i < b.size(); ++i) add_row(problem, {}, -b[i]);
  set_sigma(problem, A);
  return problem;
}

std::string text(const mlcp::Problem& problem, const mlcp::Mask* enabled, const mlcp::Mask* start) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t b = 0; b < problem.bodies.size(); ++b)
    out << "body " << b << " dimension " << problem.bodies[b].dimension
        << (problem.bodies[b].prescribed ? " prescribed\n" : "\n");
  print(out, "M", problem.mass_view());
  out << "k, given velocity\n";
  for (std::int32_t j = 0; j < problem.n(); ++j)
    out << "  " << j << ": " << problem.momentum[j] << ' ' << problem.given_velocity[j] << '\n';
  print(out, "J", problem.jacobian_view());
  print(out, "compliance", problem.compliance_view());
  out << "r lo hi\n";
  for (std::int32_t i = 0; i < problem.m(); ++i)
    out << "  " << i << ": " << problem.r[i] << ' ' << problem.lo[i] << ' ' << problem.hi[i] << '\n';
  print(out, "enabled", enabled);
  print(out, "start", start);
  return out.str();
}

}  // namespace support
