#include "friction/cone_rows.h"

#include <gtest/gtest.h>

#include "assemble/contacts.h"
#include "support/build.h"
#include "support/dense.h"
#include "support/random.h"

namespace mlcp {
namespace {

using support::Entry;

/// Two bodies; a joint, a contact in space, a plain row, a contact in the plane; Σ full if asked.
Problem example(bool full_sigma) {
  support::Random random(5);
  Problem p = support::empty_problem();
  support::add_body(p, 3, 2);
  support::add_body(p, 2, 1);
  const auto row = [&](std::vector<int> columns, support::Bounds bounds = support::unilateral) {
    std::vector<Entry> entries;
    for (const int c : columns) entries.push_back({c, random.uniform(-1, 1)});
    support::add_row(p, entries, random.uniform(-1, 1), bounds);
  };
  row({0, 3}, support::bilateral);
  row({0, 1, 4});
  row({4, 2});  // another pattern than the normal
  row({1});
  row({2});
  row({3, 4});
  row({3});
  if (full_sigma) {
    Eigen::MatrixXd b(7, 7);
    for (int i = 0; i < 49; ++i) b(i / 7, i % 7) = random.uniform(-1, 1);
    support::set_sigma(p, b * b.transpose());
  }
  const std::int32_t space = 1, plane = 5;
  const double mu = 0.7;
  contacts_declare(p, 1, 3, &space, {nullptr, &mu, nullptr, nullptr});
  contacts_declare(p, 1, 2, &plane, {nullptr, &mu, nullptr, nullptr});
  return p;
}

/// G by definition: inner rows in terms of the caller's.
support::Matrix weights(const Problem& p, const Generators& generators, const ConeRows& rows) {
  support::Matrix g = support::Matrix::Zero(rows.inner.m(), p.m());
  for (int i = 0; i < rows.inner.m(); ++i) {
    g(i, rows.row_of[i]) = 1;
    const int cone = rows.cone_of_row[i];
    if (cone < 0) continue;
    const Contact& contact = p.contacts[generators.contact[cone]];
    const Tangent d = generators.direction[generators.first[cone] + i - rows.inner_of[contact.row]];
    g(i, contact.row + 1) = contact.mu * d.x;
    if (contact.dimension == 3) g(i, contact.row + 2) = contact.mu * d.y;
  }
  return g;
}

TEST(ConeRows, rows_inside_are_G_times_the_callers) {
  for (const bool full : {false, true}) {
    const Problem p = example(full);
    Generators generators{Memory()};
    ConeRows rows{Memory()};
    generators.start(p, nullptr, 0);
    rows.build(p, nullptr, generators);
    for (std::int32_t c = 0; c < generators.cones(); ++c) rows.write_shift(p, generators, c, 0.25);
    const support::Matrix g = weights(p, generators, rows);
    const support::Dense outside = support::dense(p), inside = support::dense(rows.inner);
    EXPECT_LE((inside.J - g * outside.J).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LE((inside.S - g * outside.S * g.transpose()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(inside.S, inside.S.transpose()) << "both triangles get the same bits";
    support::Vector r = g * outside.r;
    for (int i = 0; i < r.size(); ++i) r[i] -= rows.cone_of_row[i] < 0 ? 0 : 0.25L;
    EXPECT_LE((inside.r - r).cwiseAbs().maxCoeff(), 1e-15);

    std::vector<double> beta(rows.inner.m()), gamma(p.m());
    for (std::size_t i = 0; i < beta.size(); ++i) beta[i] = 0.1 * double(i + 1);
    rows.impulses(p, generators, beta, gamma);
    EXPECT_LE((g.transpose() * support::widen(beta) - support::widen(gamma)).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(ConeRows, a_generator_that_is_aimed_anew_changes_values_alone) {
  const Problem p = example(true);
  Generators generators{Memory()};
  ConeRows rows{Memory()}, fresh{Memory()};
  generators.start(p, nullptr, 0);
  rows.build(p, nullptr, generators);
  const Array<std::int32_t> pattern = rows.inner.jacobian.indices;
  ASSERT_GE(generators.aim(p, 0, {0.6, 0.8}, true, nullptr, nullptr), 0);
  rows.write_rows(p, generators, 0);
  rows.write_shift(p, generators, 0, 0);
  rows.write_compliance(p, generators);
  fresh.build(p, nullptr, generators);
  EXPECT_TRUE(std::equal(pattern.begin(), pattern.end(), rows.inner.jacobian.indices.begin(), rows.inner.jacobian.indices.end()));
  EXPECT_TRUE(std::equal(rows.inner.jacobian.values.begin(), rows.inner.jacobian.values.end(), fresh.inner.jacobian.values.begin()));
  EXPECT_TRUE(std::equal(rows.inner.compliance.values.begin(), rows.inner.compliance.values.end(), fresh.inner.compliance.values.begin()));
  EXPECT_TRUE(std::equal(rows.inner.r.begin(), rows.inner.r.end(), fresh.inner.r.begin()));
}

TEST(ConeRows, hard_contacts_have_nothing_off_the_diagonal) {
  const Problem p = example(false);
  Generators generators{Memory()};
  ConeRows rows{Memory()};
  generators.start(p, nullptr, 0);
  rows.build(p, nullptr, generators);
  EXPECT_EQ(rows.inner.compliance.values.size(), std::size_t(rows.inner.m()));
}

TEST(Generators, guards_stay_and_active_ones_are_not_taken) {
  const Problem p = example(false);
  Generators generators{Memory()};
  generators.start(p, nullptr, 0);
  std::vector<mlcp_row_state> state(6, MLCP_ROW_AT_LOWER);
  const std::vector<double> w = {9, 1, 9, 3, 9, 2};
  state[3] = MLCP_ROW_ACTIVE;
  EXPECT_EQ(generators.aim(p, 0, {0.6, 0.8}, false, state.data(), w.data()), 5);
  EXPECT_EQ(generators.aim(p, 0, {0.6, 0.8}, false, state.data(), w.data()), -1) << "there is one already";
  state[1] = state[5] = MLCP_ROW_ACTIVE;
  EXPECT_EQ(generators.aim(p, 0, {0.8, 0.6}, false, state.data(), w.data()), -1) << "none to spare";
  EXPECT_EQ(generators.tried[0], 7);
}

TEST(Generators, pyramids_up_to_six_facets_are_complete) {
  const Problem p = example(false);
  for (const std::int32_t facets : {3, 4, 5, 6, 7, 100}) {
    Generators generators{Memory()};
    generators.start(p, nullptr, facets);
    EXPECT_EQ(generators.complete(p, 0), facets <= 6);
    EXPECT_EQ(generators.first[1], std::min(facets, 6));
    for (std::int32_t k = 1; k < generators.first[1]; ++k)
      EXPECT_GT(length({generators.direction[k].x - generators.direction[k - 1].x, generators.direction[k].y - generators.direction[k - 1].y}), 0.01);
  }
}

}  // namespace
}  // namespace mlcp
