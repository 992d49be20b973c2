#include "conflicts.h"

#include <algorithm>

namespace mlcp {

void Conflicts::start(const Problem& problem) {
  proven_.assign(problem.m(), 0);
  certificates_.clear();
  row_.clear();
  y_.clear();
  looked_at_normals_ = false;
}

bool Conflicts::shifted(const Problem& problem, const Generators& generators, const ConeRows& rows, const Result& inner,
                        const CertificateRange& range) const {
  const auto first = inner.certificate_row.begin() + range.first;
  return std::any_of(first, first + range.count, [&](std::int32_t row) {
    const std::int32_t cone = rows.cone_of_row[row];
    return cone >= 0 && problem.contacts[generators.contact[cone]].model == MLCP_FRICTION_COULOMB;
  });
}

/// Keeps the certificate of an island that has none yet.
void Conflicts::add(std::span<const std::int32_t> row, std::span<const double> y, const ConeRows& rows, const Result& inner) {
  if (proven_[row[0]]) return;
  const std::int32_t island = inner.row_island[rows.inner_of[row[0]]];
  for (std::size_t i = 0; i < rows.row_of.size(); ++i)
    if (inner.row_island[i] == island) proven_[rows.row_of[i]] = 1;
  certificates_.push_back({-1, static_cast<std::int32_t>(row_.size()), static_cast<std::int32_t>(row.size())});
  for (std::size_t e = 0; e < row.size(); ++e) {
    row_.push_back(row[e]);
    y_.push_back(y[e]);
  }
}

void Conflicts::look(const Problem& problem, const Mask* enabled, const Generators& generators, const ConeRows& rows, const Result& inner,
                     const Settings& left, mlcp_report& spent) {
  bool open = false;
  Array<std::int32_t> row(memory_);
  Array<double> y(memory_);
  for (const CertificateRange& range : inner.certificates) {
    if (proven_[rows.row_of[inner.certificate_row[range.first]]]) continue;
    if (shifted(problem, generators, rows, inner, range)) {
      open = true;
      continue;
    }
    beta_.assign(rows.row_of.size(), 0.0);
    for (std::int32_t e = range.first; e < range.first + range.count; ++e) beta_[inner.certificate_row[e]] = inner.certificate_y[e];
    gamma_.resize(problem.m());
    rows.impulses(problem, generators, beta_.span(), gamma_.span());
    row.clear();
    y.clear();
    for (std::int32_t i = 0; i < problem.m(); ++i) {
      if (gamma_[i] == 0) continue;
      row.push_back(i);
      y.push_back(gamma_[i]);
    }
    add(row.span(), y.span(), rows, inner);
  }
  if (open && !looked_at_normals_) look_at_normals(problem, enabled, rows, inner, left, spent);
}

/// The problem without tangent rows and without rows whose bounds follow another one.
void Conflicts::look_at_normals(const Problem& problem, const Mask* enabled, const ConeRows& rows, const Result& inner, const Settings& left,
                                mlcp_report& spent) {
  looked_at_normals_ = true;
  if (enabled)
    normals_.state.assign(enabled->state.span());
  else
    normals_.state.assign(problem.m(), MLCP_ROW_ACTIVE);
  for (std::int32_t i = 0; i < problem.m(); ++i)
    if (rows.inner_of[i] < 0) normals_.state[i] = MLCP_ROW_DISABLED;
  for (const Coupling& coupling : problem.couplings) normals_.state[coupling.row] = MLCP_ROW_DISABLED;
  Solver solver(left, memory_);
  solver.solve(problem, &normals_, nullptr, spent);
  const Result& found = solver.result();
  for (const CertificateRange& range : found.certificates)
    add(found.certificate_row.span().subspan(range.first, range.count), found.certificate_y.span().subspan(range.first, range.count), rows, inner);
}

void Conflicts::write(Result& result) const {
  result.certificates.clear();
  for (const CertificateRange& range : certificates_) result.certificates.push_back({result.row_island[row_[range.first]], range.first, range.count});
  result.certificate_row.assign(row_.span());
  result.certificate_y.assign(y_.span());
}

}  // namespace mlcp
