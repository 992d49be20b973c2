// Convex quadratic programs after those of Maros & Mészáros (1999), written out from their formulas: many bounds, masses that are singular or not there,
// rows that depend on each other. They are no multibody systems, and break what is tuned to those.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/build.h"
#include "support/random.h"
#include "support/solution.h"

namespace support {
namespace {

constexpr mlcp_method methods[] = {MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON};
constexpr double inf = std::numeric_limits<double>::infinity();

void add_sides(mlcp::Problem& p, const std::vector<Entry>& entries, double low, double high) {
  if (low == high) {
    add_row(p, entries, low, bilateral);
    return;
  }
  std::vector<Entry> mirrored = entries;
  for (Entry& e : mirrored) e.value = -e.value;
  if (low > -inf) add_row(p, entries, low);
  if (high < inf) add_row(p, mirrored, -high);
}

void expect_solved(const std::string& name, const mlcp::Problem& p) {
  for (const mlcp_method method : methods) {
    mlcp::Settings how = settings();
    how.method = method;
    const Solution s = solve(p, how);
    EXPECT_EQ(s.report.outcome, MLCP_SOLVED) << name << " by " << mlcp_method_text(method);
    EXPECT_LE(s.report.largest_error, 1e-12) << name << " by " << mlcp_method_text(method);
  }
}

/// ½ Σ i (x_i + x_j + x_k)² under rows on three variables each, around x = ½, which is feasible, within 0.1 … 10.
TEST(Programs, Cvxqp) {
  for (const int n : {10, 50, 100, 200})
    for (const int rows : {n / 4, n / 2, 3 * n / 4}) {
      const auto of = [n](int factor, int i) { return (factor * i - 1) % n; };
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
      for (int i = 1; i <= n; ++i) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
        for (const int j : {i - 1, of(2, i), of(3, i)}) sum[j] += 1;
        mass += i * sum * sum.transpose();
      }
      mlcp::Problem p = empty_problem();
      add_sparse_body(p, mass);
      for (int i = 1; i <= rows; ++i) {
        std::map<int, double> sum;
        sum[i - 1] += 1;
        sum[of(4, i)] += 2;
        sum[of(5, i)] += 3;
        std::vector<Entry> entries;
        for (const auto& [j, value] : sum) entries.push_back({j, value});
        add_sides(p, entries, 3, 3);
      }
      for (int j = 0; j < n; ++j) add_sides(p, {{j, 1}}, 0.1, 10);
      expect_solved("CVXQP " + std::to_string(n) + ", " + std::to_string(rows), p);
    }
}

/// Differences y_i = x_{i+1} − x_i have a mass, the x themselves have none.
TEST(Programs, Gouldqp2) {
  for (const int n : {4, 30, 200}) {
    Random random(n);
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 * n - 1, 2 * n - 1);
    mass.bottomRightCorner(n - 1, n - 1).setIdentity();
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, mass);
    for (double& k : p.momentum) k = 0.01 * random.uniform();
    for (int i = 0; i + 1 < n; ++i) add_sides(p, {{i, -1}, {i + 1, 1}, {n + i, -1}}, 0, 0);
    for (int i = 0; i < n; ++i) add_sides(p, {{i, 1}}, -10, 10);
    for (int i = 0; i + 1 < n; ++i) add_sides(p, {{n + i, 1}}, -1 + 0.01 * std::abs(random.uniform()), 2);
    expect_solved("GOULDQP2 " + std::to_string(n), p);
  }
}

/// The nearest sequence whose second, third or fourth differences are not negative: conditions up to the eighth power of the length.
TEST(Programs, Liswet) {
  const std::vector<double> differences[] = {{1, -2, 1}, {-1, 3, -3, 1}, {1, -4, 6, -4, 1}};
  for (const int n : {20, 100})
    for (const auto& d : differences) {
      mlcp::Problem p = empty_problem();
      add_sparse_body(p, Eigen::MatrixXd::Identity(n, n));
      for (int i = 0; i < n; ++i) p.momentum[i] = std::pow(double(i) / n, 3) + 0.1 * std::sin(i + 1.0);
      for (int i = 0; i + d.size() <= static_cast<std::size_t>(n); ++i) {
        std::vector<Entry> entries;
        for (std::size_t t = 0; t < d.size(); ++t) entries.push_back({i + static_cast<int>(t), d[t]});
        add_row(p, entries, 0);
      }
      expect_solved("LISWET " + std::to_string(n) + ", " + std::to_string(d.size() - 1), p);
    }
}

/// A cycle of sums that have to alternate by more and more.
TEST(Programs, Powell20) {
  for (const int n : {10, 300}) {
    mlcp::Problem p = empty_problem();
    add_sparse_body(p, Eigen::MatrixXd::Identity(n, n));
    for (int k = 1; k < n; ++k) {
      const double s = k % 2 ? -1 : 1;
      add_row(p, {{k - 1, s}, {k, -s}}, k - 0.5);
    }
    add_row(p, {{0, 1}, {n - 1, -1}}, n - 0.5);
    expect_solved("POWELL20 " + std::to_string(n), p);
  }
}

}  // namespace
}  // namespace support
