#include "fclib_file.h"

// FCLIB: reads and writes its HDF5 files; a C header that does not say so
extern "C" {
#include <fclib.h>
}

#include <cstdlib>
#include <memory>

#include "problem_form.h"
#include "text_file.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct Delete {
  void operator()(fclib_local* p) const {
    fclib_delete_local(p);
    std::free(p);
  }
  void operator()(fclib_global* p) const {
    fclib_delete_global(p);
    std::free(p);
  }
};

/// nz ≥ 0: triplets; −1: compressed columns; −2: compressed rows.
Matrix matrix_of(const fclib_matrix& from, const fs::path& path) {
  Matrix matrix;
  matrix.source = path.string();
  matrix.rows = from.m;
  matrix.columns = from.n;
  const auto add = [&](std::int32_t i, std::int32_t j, double value) {
    if (i < 0 || i >= from.m || j < 0 || j >= from.n) throw std::runtime_error(matrix.source + ": an entry is outside its matrix");
    matrix.add(i, j, value);
  };
  if (from.nz >= 0) {
    for (int e = 0; e < from.nz; ++e) add(from.p[e], from.i[e], from.x[e]);
    return matrix;
  }
  const std::int32_t outer = from.nz == -1 ? from.n : from.m;
  for (std::int32_t o = 0; o < outer; ++o) {
    if (from.p[o] < 0 || from.p[o + 1] < from.p[o] || from.p[o + 1] > from.nzmax) {
      throw std::runtime_error(matrix.source + ": pointers of a matrix are not ascending");
    }
    for (int e = from.p[o]; e < from.p[o + 1]; ++e) {
      if (from.nz == -1) add(from.i[e], o, from.x[e]);
      else add(o, from.i[e], from.x[e]);
    }
  }
  return matrix;
}

/// Adds block `from` (its transpose) at row i, column j.
void put(const Matrix& from, std::int32_t i, std::int32_t j, bool transposed, Matrix& to) {
  for (std::size_t e = 0; e < from.value.size(); ++e) {
    const std::int32_t row = transposed ? from.column[e] : from.row[e], column = transposed ? from.row[e] : from.column[e];
    to.add(i + row, j + column, from.value[e]);
  }
}

void append(const double* values, std::int32_t count, std::vector<double>& to) {
  for (std::int32_t i = 0; i < count; ++i) to.push_back(values ? values[i] : 0.0);
}

/// Contacts from the number of rows and spacedim.
void take_contacts(std::int32_t rows, int spacedim, const double* mu, const fs::path& path, ProblemForm& form) {
  if ((spacedim != 2 && spacedim != 3) || rows % spacedim != 0 || !mu) {
    throw std::runtime_error(path.string() + ": " + std::to_string(rows) + " rows are not contacts of dimension " + std::to_string(spacedim));
  }
  form.dimension = spacedim;
  form.contacts = rows / spacedim;
  append(mu, form.contacts, form.mu);
}

ProblemForm form_of_local(const fclib_local& local, const fs::path& path) {
  ProblemForm form;
  form.reduced = true;
  const Matrix w = matrix_of(*local.W, path);
  if (local.R) form.bilateral = local.R->m;
  form.a.source = path.string();
  form.a.rows = form.a.columns = form.bilateral + w.rows;
  if (local.R) put(matrix_of(*local.R, path), 0, 0, false, form.a);
  if (local.V) {
    const Matrix v = matrix_of(*local.V, path);
    if (v.rows != w.rows || v.columns != form.bilateral) throw std::runtime_error(path.string() + ": V does not fit W and R");
    put(v, form.bilateral, 0, false, form.a);
    put(v, 0, form.bilateral, true, form.a);
  }
  put(w, form.bilateral, form.bilateral, false, form.a);
  append(local.s, form.bilateral, form.shift);
  append(local.q, w.rows, form.shift);
  take_contacts(w.rows, local.spacedim, local.mu, path, form);
  return form;
}

ProblemForm form_of_global(const fclib_global& global, const fs::path& path) {
  ProblemForm form;
  form.mass = matrix_of(*global.M, path);
  append(global.f, form.mass.rows, form.k);
  const Matrix h = matrix_of(*global.H, path);
  if (global.G) form.bilateral = global.G->n;
  if (h.rows != form.mass.rows || (global.G && global.G->m != form.mass.rows)) throw std::runtime_error(path.string() + ": H or G does not fit M");
  form.jacobian.source = path.string();
  form.jacobian.rows = form.bilateral + h.columns;
  form.jacobian.columns = form.mass.rows;
  if (global.G) put(matrix_of(*global.G, path), 0, 0, true, form.jacobian);
  put(h, form.bilateral, 0, true, form.jacobian);
  append(global.b, form.bilateral, form.shift);
  append(global.w, h.columns, form.shift);
  take_contacts(h.columns, global.spacedim, global.mu, path, form);
  return form;
}

/// A matrix in FCLIB's terms over entries that stay here.
struct Triplets {
  Matrix entries;
  fclib_matrix matrix{};

  /// Rows and columns of `from` within the ranges, moved to 0; transposed if asked.
  Triplets(const Matrix& from, std::int32_t first_row, std::int32_t rows, std::int32_t first_column, std::int32_t columns, bool transposed) {
    for (std::size_t e = 0; e < from.value.size(); ++e) {
      const std::int32_t i = from.row[e] - first_row, j = from.column[e] - first_column;
      if (i < 0 || i >= rows || j < 0 || j >= columns) continue;
      entries.add(transposed ? j : i, transposed ? i : j, from.value[e]);
    }
    const auto count = static_cast<int>(entries.value.size());
    matrix = {count, transposed ? columns : rows, transposed ? rows : columns, entries.row.data(), entries.column.data(),
              entries.value.data(), count, nullptr};
  }
};

}  // namespace

ProblemFile read_fclib(const fs::path& path, const Friction& friction) {
  // FCLIB prints when it is asked for the form that is not there; HDF5 stores the names of groups as they are
  if (read_text(path).find("fclib_global") == std::string::npos) {
    const std::unique_ptr<fclib_local, Delete> local(fclib_read_local(path.c_str()));
    if (local) return make_problem(form_of_local(*local, path), friction);
  } else {
    const std::unique_ptr<fclib_global, Delete> global(fclib_read_global(path.c_str()));
    if (global) return make_problem(form_of_global(*global, path), friction);
  }
  throw std::runtime_error(path.string() + ": holds neither a local nor a global FCLIB problem");
}

void write_fclib(const fs::path& path, const handles::Problem& problem) {
  ProblemForm form = form_of(problem);
  const std::int32_t bilateral = form.bilateral, rows = form.rows() - bilateral, n = form.mass.rows;
  if (form.contacts == 0 || form.end_of_contacts() != form.rows()) {
    throw std::runtime_error("an FCLIB file holds bilateral rows and contacts, no plain unilateral rows");
  }
  if (fs::exists(path)) throw std::runtime_error(path.string() + ": is there already");
  bool written = false;
  if (form.reduced) {
    Triplets w(form.a, bilateral, rows, bilateral, rows, false), v(form.a, bilateral, rows, 0, bilateral, false),
        r(form.a, 0, bilateral, 0, bilateral, false);
    fclib_local local{&w.matrix, bilateral ? &v.matrix : nullptr, bilateral ? &r.matrix : nullptr, form.mu.data(),
                      form.shift.data() + bilateral, bilateral ? form.shift.data() : nullptr, form.dimension, nullptr};
    written = fclib_write_local(&local, path.c_str()) == 1;
  } else {
    Triplets m(form.mass, 0, n, 0, n, false), h(form.jacobian, bilateral, rows, 0, n, true), g(form.jacobian, 0, bilateral, 0, n, true);
    fclib_global global{&m.matrix, &h.matrix, bilateral ? &g.matrix : nullptr, form.mu.data(), form.k.data(),
                        bilateral ? form.shift.data() : nullptr, form.shift.data() + bilateral, form.dimension, nullptr};
    written = fclib_write_global(&global, path.c_str()) == 1;
  }
  if (!written) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace cli
