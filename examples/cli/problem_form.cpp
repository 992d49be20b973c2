#include "problem_form.h"

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

using handles::check;

std::int32_t kept_of_group(const ProblemForm& form, const Friction& friction) {
  return friction.model.value_or(MLCP_FRICTION_NONE) == MLCP_FRICTION_NONE ? 1 : std::min(form.dimension, 3);
}

/// Which rows of the file are in the problem. Fills file.file_row; returns for each row of the file its index in the problem or −1.
std::vector<std::int32_t> choose_rows(const ProblemForm& form, std::int32_t kept, ProblemFile& file) {
  file.file_rows = form.rows();
  std::vector<std::int32_t> new_index(static_cast<std::size_t>(file.file_rows), -1);
  for (std::int32_t i = 0; i < file.file_rows; ++i) {
    const bool in_group = i >= form.bilateral && i < form.end_of_contacts();
    if (in_group && (i - form.bilateral) % form.dimension >= kept) continue;
    new_index[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(file.file_row.size());
    file.file_row.push_back(i);
  }
  return new_index;
}

/// The library's own words on what stands in a file. It counts from 0, and only the rows that were chosen.
[[noreturn]] void refuse_rows(const Matrix& matrix, const ProblemFile& file) {
  const bool whole = file.file_row.size() == static_cast<std::size_t>(file.file_rows);
  throw std::runtime_error(matrix.source + ": " + mlcp_problem_error(file.problem.get()) + " (counted from 0" +
                           (whole ? ")" : ", without the rows of friction)"));
}

void add_body(const ProblemForm& form, const ProblemFile& file) {
  if (form.mass.rows == 0) return;
  const Compressed columns = compress_columns(form.mass);
  const mlcp_triangle triangle = form.mass.symmetric ? MLCP_LOWER : MLCP_FULL;
  if (mlcp_problem_body_add_sparse(file.problem.get(), form.mass.rows, columns.pointers.data(), columns.indices.data(),
                                   columns.values.data(), triangle, nullptr) != MLCP_OK) {
    throw std::runtime_error(form.mass.source + ": " + mlcp_problem_error(file.problem.get()) + " (counted from 0)");
  }
  check(mlcp_problem_set_momentum(file.problem.get(), 0, form.mass.rows, form.k.data()), file.problem);
}

/// In the library's signs: r = −shift.
void add_rows(const ProblemForm& form, const Compressed& jacobian, const ProblemFile& file) {
  std::vector<double> r, lo;
  std::vector<std::uint64_t> key;
  for (const std::int32_t i : file.file_row) {
    r.push_back(0.0 - form.shift[static_cast<std::size_t>(i)]);
    lo.push_back(i < form.bilateral ? -INFINITY : 0.0);
    key.push_back(form.key.empty() ? 0 : form.key[static_cast<std::size_t>(i)]);
  }
  if (r.empty()) return;
  check(mlcp_problem_rows_add_csr(file.problem.get(), static_cast<std::int32_t>(r.size()), jacobian.pointers.data(),
                                  jacobian.indices.data(), jacobian.values.data(), r.data(), lo.data(), nullptr, nullptr,
                                  key.data(), nullptr),
        file.problem);
}

void add_compliance(const ProblemForm& form, const std::vector<std::int32_t>& new_index, const ProblemFile& file) {
  const auto count = static_cast<std::int32_t>(file.file_row.size());
  const Compressed columns = compress_columns(select_rows_and_columns(form.a, new_index, count));
  if (mlcp_problem_set_compliance_matrix(file.problem.get(), count, columns.pointers.data(), columns.indices.data(),
                                         columns.values.data(), form.a.symmetric ? MLCP_LOWER : MLCP_FULL) != MLCP_OK) {
    refuse_rows(form.a, file);
  }
}

/// Tells the library which of its rows are contacts.
void declare_contacts(const ProblemForm& form, std::int32_t kept, const Friction& friction, const ProblemFile& file) {
  if (kept == 1 || form.contacts == 0) return;
  std::vector<std::int32_t> row;
  for (std::int32_t c = 0; c < form.contacts; ++c) row.push_back(form.bilateral + c * kept);
  const std::vector<mlcp_friction> model(row.size(), *friction.model);
  const std::vector<std::int32_t> facets(row.size(), friction.facets);
  check(mlcp_problem_contacts_declare(file.problem.get(), form.contacts, kept, row.data(), model.data(), form.mu.data(), nullptr,
                                      facets.data()),
        file.problem);
}

}  // namespace

ProblemFile make_problem(const ProblemForm& form, const Friction& friction) {
  ProblemFile file;
  file.problem = handles::make_problem();
  file.solver = handles::make_solver();
  file.contacts = {std::vector<std::int32_t>(static_cast<std::size_t>(form.contacts), form.dimension), form.mu, {}};
  const std::int32_t kept = kept_of_group(form, friction);
  const std::vector<std::int32_t> new_index = choose_rows(form, kept, file);
  const auto count = static_cast<std::int32_t>(file.file_row.size());
  if (form.reduced) {
    Compressed empty;
    empty.pointers.assign(static_cast<std::size_t>(count) + 1, 0);
    add_rows(form, empty, file);
    add_compliance(form, new_index, file);
  } else {
    add_body(form, file);
    add_rows(form, compress_rows(select_rows(form.jacobian, new_index, count)), file);
  }
  declare_contacts(form, kept, friction, file);
  return file;
}

}  // namespace cli
