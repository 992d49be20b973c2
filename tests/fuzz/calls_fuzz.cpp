// Any calls in any order, with NULL for handles and arrays, wrong counts, indices out of range, an allocator that gives up, and results read
// after a failure. Every call ends in a status that the header has, a call that fails changes nothing, and nothing is left behind.
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "input.h"
#include "mlcp.h"

namespace {

using fuzz::Input;
using Bytes = std::vector<unsigned char>;

/// Fails when a countdown that the input has set runs out, and on until it is set anew.
struct Allocator {
  static constexpr std::int64_t never = INT64_MAX;
  std::int64_t left = never, blocks = 0;

  static void* reallocate(void* context, void* block, std::size_t, std::size_t size) {
    Allocator& self = *static_cast<Allocator*>(context);
    if (self.left != never && self.left-- <= 0) return self.left = 0, nullptr;
    self.blocks += !block;
    return std::realloc(block, size);
  }
  static void release(void* context, void* block, std::size_t) {
    --static_cast<Allocator*>(context)->blocks;
    std::free(block);
  }
  mlcp_allocator hooks() { return {this, reallocate, release}; }
};

template <class Handle, void (*destroy)(Handle*)>
struct Slot {
  Handle* handle = nullptr;
  ~Slot() { destroy(handle); }
  /// Where a function leaves a new object instead of this one.
  Handle** fresh() {
    destroy(handle);
    handle = nullptr;
    return &handle;
  }
};

/// A struct of a later version, whose struct_size may be anything that a byte says: what stands behind it is the caller's, mostly zeros.
template <class Struct>
struct Later : Struct {
  unsigned char more[256] = {};
};

class Session {
 public:
  explicit Session(Input& in) : in_(in) {}
  ~Session() { allocator_.left = Allocator::never; }

  void run();

 private:
  // ------------------------------------------------------------------------------------------------------- arguments

  /// An array of exactly that many entries on the heap, where a sanitizer sees what is read beyond it; NULL now and then.
  template <class T, class Make>
  T* array(std::int64_t count, Make make) {
    if (in_.one_in(16)) return nullptr;
    const std::size_t size = count > 0 && count < 4096 ? static_cast<std::size_t>(count) : 0;
    const std::shared_ptr<T[]> memory(new T[size]);
    for (std::size_t i = 0; i < size; ++i) memory[i] = make();
    arrays_.push_back(memory);
    return memory.get();
  }
  double* numbers(std::int64_t count) {
    return array<double>(count, [&] { return in_.number(); });
  }
  float* singles(std::int64_t count) {
    return array<float>(count, [&] { return static_cast<float>(static_cast<double>(in_.integer(0, 16) - 8) / 4); });
  }
  std::int32_t* indices(std::int64_t count, int most) {
    return array<std::int32_t>(count, [&] { return index(most); });
  }
  std::uint64_t* keys(std::int64_t count) {
    return array<std::uint64_t>(count, [&] { return static_cast<std::uint64_t>(in_.integer(0, 5)); });
  }
  /// Mostly in range.
  std::int32_t index(int most) { return in_.one_in(24) ? odd_[in_.byte() % odd_.size()] : in_.integer(0, most > 0 ? most : 0); }
  /// Mostly what it has to be, for counts that the function compares with something.
  std::int32_t count(std::int64_t right) { return in_.one_in(12) ? odd_[in_.byte() % odd_.size()] : static_cast<std::int32_t>(right); }
  /// For counts that say how much is to be read.
  std::int32_t some() { return in_.one_in(24) ? -1 : in_.integer(0, 5); }
  /// Compressed columns: mostly what they have to be.
  std::int32_t* pointers(std::int64_t columns, std::int32_t& entries) {
    entries = 0;
    bool first = true;
    return array<std::int32_t>(columns + 1, [&] {
      entries += first ? 0 : in_.integer(0, 2);
      first = false;
      return in_.one_in(60) ? -1 : entries;
    });
  }
  template <class T>
  T* maybe(T* pointer) {
    return in_.one_in(16) ? nullptr : pointer;
  }
  template <class Struct>
  void resize(Later<Struct>& s) {
    if (!in_.one_in(24)) return;
    s.struct_size = static_cast<std::size_t>(in_.byte());
    s.more[0] = in_.one_in(4);
  }
  std::ptrdiff_t stride(std::size_t unit) { return in_.one_in(3) ? static_cast<std::ptrdiff_t>(2 * unit) : 0; }

  mlcp_problem* problem() { return in_.one_in(40) ? nullptr : problems_[in_.byte() % problems_.size()].handle; }
  mlcp_solver* solver() { return in_.one_in(40) ? nullptr : solvers_[in_.byte() % solvers_.size()].handle; }
  mlcp_mask* mask() { return in_.one_in(4) ? nullptr : masks_[in_.byte() % masks_.size()].handle; }
  std::int32_t rows_of(const mlcp_problem* p) { return mlcp_problem_row_count(p); }
  std::int32_t n_of(const mlcp_problem* p) { return mlcp_problem_velocity_count(p); }

  // ----------------------------------------------------------------------------------------------------------- calls

  void look(mlcp_status status) {
    fuzz::require(status >= MLCP_OK && status < MLCP_ERROR_INTERNAL, "a status that the header has, and no defect");
    fuzz::require(status != MLCP_ERROR_OUT_OF_MEMORY || allocator_.left == 0, "memory runs out only where it does");
    fuzz::require(*mlcp_status_text(status), "a status has a name");
  }
  /// A call that may change a problem: when it fails, it has not.
  template <class Call>
  void edit(Call call) {
    mlcp_problem* p = problem();
    const bool compare = in_.one_in(8);
    const Bytes before = compare ? bytes_of(p) : Bytes();
    const mlcp_status status = call(p);
    look(status);
    if (status == MLCP_OK) return;
    fuzz::require(!p || *mlcp_problem_error(p), "a failure leaves a text");
    if (compare) fuzz::require(bytes_of(p) == before, "a call that fails changes nothing");
  }
  Bytes bytes_of(const mlcp_problem* p) {
    if (!p) return {};
    const std::int64_t left = std::exchange(allocator_.left, Allocator::never);
    std::size_t size = 0;
    fuzz::require(mlcp_snapshot_write(p, nullptr, nullptr, nullptr, 0, nullptr, &size, nullptr, 0) == MLCP_OK, "a snapshot has a size");
    Bytes bytes(size);
    fuzz::require(mlcp_snapshot_write(p, nullptr, nullptr, nullptr, size, bytes.data(), &size, nullptr, 0) == MLCP_OK, "a snapshot is written");
    allocator_.left = left;
    return bytes;
  }

  void objects();
  void bodies();
  void rows();
  void bulk_rows();
  void values();
  void contacts();
  void read_back();
  void timestep();
  void masks();
  void solve();
  void results();
  void snapshots();
  Later<mlcp_settings> settings();
  template <class Rows>
  void fill_rows(Rows& rows, const mlcp_problem* p);

  Input& in_;
  Allocator allocator_;
  mlcp_allocator hooks_ = allocator_.hooks();
  std::vector<std::shared_ptr<void>> arrays_;
  std::array<Slot<mlcp_problem, mlcp_problem_destroy>, 2> problems_;
  std::array<Slot<mlcp_solver, mlcp_solver_destroy>, 2> solvers_;
  std::array<Slot<mlcp_mask, mlcp_mask_destroy>, 3> masks_;
  static constexpr std::array<std::int32_t, 6> odd_ = {-1, INT32_MIN, INT32_MAX, 7, 100, 1 << 30};
};

void Session::objects() {
  const mlcp_problem* p = problem();
  switch (in_.integer(0, 7)) {
    case 0: return look(mlcp_problem_create(maybe(&hooks_), maybe(problems_[in_.integer(0, 1)].fresh())));
    case 1: {
      const Later<mlcp_settings> wanted = settings();
      return look(mlcp_solver_create(maybe(&wanted), maybe(&hooks_), maybe(solvers_[in_.integer(0, 1)].fresh())));
    }
    case 2: return look(mlcp_mask_create(maybe(&hooks_), some(), static_cast<mlcp_row_state>(in_.integer(0, 4)), maybe(masks_[in_.integer(0, 2)].fresh())));
    case 3: {
      mlcp_problem* copy = nullptr;
      const mlcp_status status = mlcp_problem_clone(p, maybe(&copy));
      if (copy) *problems_[in_.integer(0, 1)].fresh() = copy;
      return look(status);
    }
    case 4: {
      mlcp_mask* copy = nullptr;
      look(mlcp_mask_clone(&hooks_, mask(), maybe(&copy)));
      if (copy) *masks_[in_.integer(0, 2)].fresh() = copy;
      return;
    }
    case 5: return edit([](mlcp_problem* q) { return mlcp_problem_trim(q); });
    case 6: return edit([](mlcp_problem* q) { return mlcp_problem_clear(q); });
    default: return edit([&](mlcp_problem* q) { return mlcp_problem_reserve(q, some(), some(), some(), some()); });
  }
}

void Session::bodies() {
  std::int32_t id = 0;
  switch (in_.integer(0, 6)) {
    case 0: case 1: return edit([&](mlcp_problem* p) {
      const std::int32_t many = some(), d = in_.integer(0, 4);
      double* masses = array<double>(std::int64_t(2) * many * d * d, [&] { return 0.0; });
      const std::ptrdiff_t gap = stride(sizeof(double) * static_cast<std::size_t>(d * d));
      for (std::int64_t b = 0; masses && b < many; ++b)
        for (int j = 0; j < d; ++j) masses[b * d * d * (gap ? 2 : 1) + j * d + j] = in_.number();
      return mlcp_problem_bodies_add(p, many, d, masses, gap, maybe(array<std::int32_t>(many, [] { return 0; })));
    });
    case 2: return edit([&](mlcp_problem* p) {
      const std::int32_t d = in_.integer(0, 4);
      std::int32_t entries = 0;
      const std::int32_t* columns = pointers(d, entries);
      return mlcp_problem_body_add_sparse(p, d, columns, indices(entries, d - 1), numbers(entries), in_.integer(0, 3), maybe(&id));
    });
    case 3: return edit([&](mlcp_problem* p) {
      const std::int32_t entries = count(in_.integer(0, 16));
      return mlcp_problem_body_set_mass(p, index(3), numbers(entries), entries);
    });
    case 4: return edit([&](mlcp_problem* p) { return mlcp_problem_body_remove(p, index(3)); });
    case 5: return edit([&](mlcp_problem* p) {
      const std::int32_t d = count(in_.integer(1, 4));
      return mlcp_problem_body_set_prescribed(p, index(3), numbers(d), d);
    });
    default: return edit([&](mlcp_problem* p) { return mlcp_problem_body_set_dynamic(p, index(3)); });
  }
}

void Session::rows() {
  std::int32_t first = 0, entries = 0;
  switch (in_.integer(0, 4)) {
    case 0: return edit([&](mlcp_problem* p) {
      const std::int32_t many = some();
      return mlcp_problem_row_add(p, many, indices(many, n_of(p) - 1), numbers(many), in_.number(), in_.flag() ? 0 : in_.number(), in_.flag() ? 1e9 : in_.number(),
                                  in_.flag() ? 0 : in_.number(), static_cast<std::uint64_t>(in_.integer(0, 3)), maybe(&first));
    });
    case 1: return edit([&](mlcp_problem* p) {
      const std::int32_t many = some(), *at = pointers(many, entries), *columns = indices(entries, n_of(p) - 1);
      const double *j = numbers(entries), *r = numbers(many);
      return mlcp_problem_rows_add_csr(p, many, at, columns, j, r, nullptr, in_.flag() ? numbers(many) : nullptr, nullptr, keys(many), maybe(&first));
    });
    case 2: return edit([&](mlcp_problem* p) {
      const std::int32_t many = some(), *at = pointers(n_of(p), entries), *rows = indices(entries, many - 1);
      const double *j = numbers(entries), *r = numbers(many);
      return mlcp_problem_rows_add_csc(p, many, at, rows, j, r, in_.flag() ? numbers(many) : nullptr, nullptr, nullptr, keys(many), maybe(&first));
    });
    case 3: return edit([&](mlcp_problem* p) {
      const std::int32_t many = some();
      return mlcp_problem_rows_remove(p, many, indices(many, rows_of(p) - 1));
    });
    default: return edit([](mlcp_problem* p) { return mlcp_problem_rows_clear(p); });
  }
}

/// Entries as wide as bodies may be here, so that any bodies may be named.
template <class Rows>
void Session::fill_rows(Rows& rows, const mlcp_problem* p) {
  constexpr std::ptrdiff_t widest = 4;
  using Number = std::remove_const_t<std::remove_pointer_t<decltype(rows.r)>>;
  const auto floats = [&](std::int64_t many) {
    if constexpr (sizeof(Number) == sizeof(double)) return numbers(many);
    else return singles(many);
  };
  rows.count = some();
  int block = 1;
  if constexpr (requires { rows.dimension; }) {
    rows.dimension = in_.one_in(12) ? in_.integer(0, 5) : in_.integer(2, 3);
    block = rows.dimension;
    rows.mu = floats(rows.count);
    rows.bound = in_.flag() ? floats(rows.count) : nullptr;
    rows.model = in_.flag() ? indices(rows.count, MLCP_FRICTION_FINDEX) : nullptr;
    rows.facets = in_.one_in(4) ? indices(rows.count, 6) : nullptr;
  }
  const int last = mlcp_problem_body_count(p) - 1;
  const auto bodies = [&] { return array<std::int32_t>(rows.count, [&] { return in_.one_in(4) ? MLCP_WORLD : index(last); }); };
  rows.body_a = bodies();
  rows.body_b = in_.flag() ? bodies() : nullptr;
  rows.jacobian_a = floats(rows.count * block * widest);
  rows.jacobian_b = floats(rows.count * block * widest);
  rows.jacobian_a_stride = in_.flag() ? static_cast<std::ptrdiff_t>(sizeof(Number)) * block * widest : 0;
  rows.r = floats(rows.count * block);
  rows.compliance = in_.one_in(4) ? floats(rows.count * block) : nullptr;
  rows.key = keys(rows.count);
  resize(rows);
}

void Session::bulk_rows() {
  std::int32_t first = 0;
  switch (in_.integer(0, 3)) {
    case 0: return edit([&](mlcp_problem* p) {
      Later<mlcp_rows> rows;
      mlcp_rows_init(&rows, sizeof(mlcp_rows));
      fill_rows(rows, p);
      return mlcp_problem_rows_add(p, maybe(&rows), maybe(&first));
    });
    case 1: return edit([&](mlcp_problem* p) {
      Later<mlcp_rows_f32> rows;
      mlcp_rows_f32_init(&rows, sizeof(mlcp_rows_f32));
      fill_rows(rows, p);
      return mlcp_problem_rows_add_f32(p, maybe(&rows), maybe(&first));
    });
    case 2: return edit([&](mlcp_problem* p) {
      Later<mlcp_contacts> contacts;
      mlcp_contacts_init(&contacts, sizeof(mlcp_contacts));
      fill_rows(contacts, p);
      return mlcp_problem_contacts_add(p, maybe(&contacts), maybe(&first));
    });
    default: return edit([&](mlcp_problem* p) {
      Later<mlcp_contacts_f32> contacts;
      mlcp_contacts_f32_init(&contacts, sizeof(mlcp_contacts_f32));
      fill_rows(contacts, p);
      return mlcp_problem_contacts_add_f32(p, maybe(&contacts), maybe(&first));
    });
  }
}

void Session::values() {
  edit([&](mlcp_problem* p) {
    const int choice = in_.integer(0, 6);
    const std::int32_t total = choice == 0 ? n_of(p) : rows_of(p), first = index(total - 1), many = count(in_.integer(0, total > first && first >= 0 ? total - first : 0));
    switch (choice) {
      case 0: return mlcp_problem_set_momentum(p, first, many, numbers(many));
      case 1: return mlcp_problem_rows_set_r(p, first, many, numbers(many));
      case 2: {
        const double* lo = numbers(many);
        return mlcp_problem_rows_set_bounds(p, first, many, lo, in_.flag() ? lo : numbers(many));
      }
      case 3: return mlcp_problem_rows_set_compliance(p, first, many, numbers(many));
      case 4: return mlcp_problem_rows_set_keys(p, first, many, keys(many));
      case 5: {
        const std::int32_t wide = count(in_.integer(0, 8));
        return mlcp_problem_row_set_jacobian(p, first, numbers(wide), wide);
      }
      default: {
        std::int32_t entries = 0;
        const std::int32_t *at = pointers(total, entries), *inside = indices(entries, total - 1);
        return mlcp_problem_set_compliance_matrix(p, total, at, inside, numbers(entries), in_.integer(0, 3));
      }
    }
  });
}

void Session::contacts() {
  edit([&](mlcp_problem* p) {
    const std::int32_t many = some(), m = rows_of(p);
    const mlcp_friction* model = in_.flag() ? indices(many, MLCP_FRICTION_FINDEX) : nullptr;
    const double *mu = in_.flag() ? numbers(many) : nullptr, *bound = in_.one_in(4) ? numbers(many) : nullptr;
    const std::int32_t* facets = in_.one_in(4) ? indices(many, 6) : nullptr;
    switch (in_.integer(0, 2)) {
      case 0: return mlcp_problem_contacts_declare(p, many, in_.integer(1, 4), indices(many, m - 1), model, mu, bound, facets);
      case 1: return mlcp_problem_contacts_set_friction(p, index(mlcp_problem_contact_count(p) - 1), many, model, mu, bound, facets);
      default: return mlcp_problem_rows_set_findex(p, index(m - 1), many, array<std::int32_t>(many, [&] { return in_.flag() ? -1 : index(m - 1); }));
    }
  });
}

void Session::read_back() {
  const mlcp_problem* p = problem();
  std::int32_t a = 0, b = 0;
  const std::int32_t m = count(rows_of(p)), n = count(n_of(p)), contacts = count(mlcp_problem_contact_count(p));
  Later<mlcp_matrix_view> view;
  mlcp_matrix_view_init(&view, sizeof(mlcp_matrix_view));
  resize(view);
  switch (in_.integer(0, 8)) {
    case 0: return look(mlcp_problem_body_range(p, index(3), maybe(&a), maybe(&b)));
    case 1: {
      const std::int32_t room = some();  // too little, or more than is needed
      return look(mlcp_problem_bodies(p, room, indices(room, 0), maybe(&a)));
    }
    case 2: {
      const std::int32_t d = in_.integer(0, 4);
      return look(mlcp_problem_body_state(p, index(3), maybe(&a), d, numbers(d)));
    }
    case 3: return look(mlcp_problem_get_momentum(p, n, numbers(n)));
    case 4: return look(mlcp_problem_get_rows(p, m, numbers(m), numbers(m), numbers(m), numbers(m), keys(m)));
    case 5: return look(mlcp_problem_get_contacts(p, contacts, indices(contacts, 0), indices(contacts, 0), indices(contacts, 0), numbers(contacts), indices(contacts, 0)));
    case 6: return look(mlcp_problem_get_findex(p, m, indices(m, 0)));
    case 7: return look(mlcp_problem_mass(p, maybe(&view)));
    default: return look(in_.flag() ? mlcp_problem_jacobian(p, maybe(&view)) : mlcp_problem_compliance(p, maybe(&view)));
  }
}

void Session::timestep() {
  double compliance = 0, r = 0;
  switch (in_.integer(0, 3)) {
    case 0: return edit([&](mlcp_problem* p) {
      const std::int32_t n = count(n_of(p));
      return mlcp_timestep_momentum(p, in_.number(), n, numbers(n), numbers(n));
    });
    case 1: {
      const std::int32_t many = some();
      return look(mlcp_timestep_rows(in_.number(), in_.number(), in_.flag(), many, numbers(many), numbers(many), numbers(many)));
    }
    case 2: return look(mlcp_timestep_spring(in_.number(), in_.number(), in_.number(), in_.number(), maybe(&compliance), maybe(&r)));
    default: return look(mlcp_timestep_erp_cfm(in_.number(), in_.number(), in_.number(), in_.number(), maybe(&compliance), maybe(&r)));
  }
}

void Session::masks() {
  mlcp_mask* q = mask();
  const std::int32_t size = mlcp_mask_size(q), first = index(size - 1), many = count(size - (first > 0 && first < size ? first : 0));
  const auto states = [&] { return array<mlcp_row_state>(many, [&] { return static_cast<mlcp_row_state>(in_.integer(0, in_.one_in(20) ? 4 : 3)); }); };
  switch (in_.integer(0, 7)) {
    case 0: return look(mlcp_mask_resize(q, in_.one_in(10) ? -1 : in_.flag() ? rows_of(problem()) : in_.integer(0, 6), static_cast<mlcp_row_state>(in_.integer(0, 4))));
    case 1: return look(mlcp_mask_set(q, first, many, states()));
    case 2: return look(mlcp_mask_get(q, first, many, states()));
    case 3: return look(mlcp_mask_set_impulses(q, first, many, numbers(many)));
    case 4: return look(mlcp_mask_get_impulses(q, first, many, numbers(many)));
    case 5: return look(mlcp_mask_take_keys(q, problem()));
    case 6: return look(mlcp_mask_carry(q, problem(), mask(), static_cast<mlcp_row_state>(in_.integer(0, 4))));
    default:
      fuzz::require(mlcp_mask_equal(q, q) == (q != nullptr), "a mask equals itself");
      fuzz::require(mlcp_mask_count(q, MLCP_ROW_ACTIVE) <= size, "no more active rows than rows");
      fuzz::require(!mlcp_mask_states(q) == (size == 0), "states of a mask that has some");
  }
}

Later<mlcp_settings> Session::settings() {
  Later<mlcp_settings> s;
  mlcp_settings_init(&s, sizeof(mlcp_settings));
  resize(s);
  s.method = in_.integer(0, in_.one_in(20) ? 5 : 3);
  s.pivot_rule = in_.integer(0, 1);
  s.refactorize = in_.one_in(4);
  s.trace = in_.one_in(4);
  s.impulses = in_.one_in(4);
  s.canonical = in_.one_in(4);
  s.facets = in_.one_in(4) ? in_.integer(0, 8) : 0;
  s.max_work = 100000;
  s.max_shifts = 20;
  if (in_.one_in(8)) s.tolerance = in_.number();
  if (in_.one_in(8)) s.max_iterations = in_.integer(0, 20) - 1;
  if (in_.one_in(8)) s.progress = [](void*, const mlcp_progress* now) -> std::int32_t { return now->work > 100; };
  return s;
}

void Session::solve() {
  mlcp_solver* s = solver();
  const mlcp_problem* p = problem();
  Later<mlcp_report> report;
  mlcp_report_init(&report, sizeof(mlcp_report));
  resize(report);
  const mlcp_mask* start = mask();
  if (in_.one_in(4)) static_cast<void>(mlcp_solver_mask(s, &start));
  switch (in_.integer(0, 5)) {
    case 0: return look(mlcp_analyze(s, p, mask()));
    case 1: return look(mlcp_solver_trim(s));
    case 2: {
      const Later<mlcp_settings> wanted = settings();
      return look(mlcp_solver_set_settings(s, maybe(&wanted)));
    }
    case 3: {
      Later<mlcp_settings> found = settings();
      return look(mlcp_solver_get_settings(s, maybe(&found)));
    }
    default: {
      const mlcp_status status = mlcp_solve(s, p, in_.flag() ? mask() : nullptr, start, maybe(&report));
      look(status);
      fuzz::require(status == MLCP_OK || !s || *mlcp_solver_error(s), "a failure leaves a text");
    }
  }
}

void Session::results() {
  const mlcp_solver* s = solver();
  const mlcp_problem* p = problem();
  const double* real = nullptr;
  const std::int32_t* whole = nullptr;
  const std::uint8_t* small = nullptr;
  const mlcp_mask* left = nullptr;
  const mlcp_pivot* pivots = nullptr;
  std::int32_t size = 0;
  std::int64_t steps = 0;
  const auto use = [&](mlcp_status status, const auto& data) {  // what is lent can be read to its end; data is looked at after the call
    look(status);
    if (status == MLCP_OK && size > 0) fuzz::require(data[size - 1] == data[size - 1] || data[size - 1] != data[size - 1], "lent memory");
  };
  switch (in_.integer(0, 13)) {
    case 0: return use(mlcp_solver_velocities(s, &real, &size), real);
    case 1: return use(mlcp_solver_impulses(s, &real, &size), real);
    case 2: return use(mlcp_solver_slacks(s, &real, &size), real);
    case 3: return use(mlcp_solver_redundant(s, &small, &size), small);
    case 4: return use(mlcp_solver_row_islands(s, &whole, &size), whole);
    case 5: return use(mlcp_solver_island_outcomes(s, &whole, &size), whole);
    case 6: return use(mlcp_solver_contact_states(s, &small, &size), small);
    case 7: return use(mlcp_solver_contact_facets(s, maybe(&whole), maybe(&size)), whole);
    case 8: return use(mlcp_solver_certificate(s, index(3), maybe(&whole), maybe(&real), &size), real);
    case 9: return look(mlcp_solver_mask(s, maybe(&left)));
    case 10: return look(mlcp_solver_trace(s, maybe(&pivots), maybe(&steps)));
    case 11: {
      const std::int32_t d = in_.integer(0, 4);
      return look(mlcp_solver_reaction(s, p, index(3), d, numbers(d)));
    }
    case 12: {
      const bool v = in_.flag();
      const std::int32_t many = count(v ? n_of(p) : rows_of(p));
      float* out = singles(std::int64_t(2) * many);
      const std::ptrdiff_t gap = stride(sizeof(float));
      return look(v ? mlcp_solver_read_velocities_f32(s, many, out, gap) : mlcp_solver_read_impulses_f32(s, many, out, gap));
    }
    default: {
      Later<mlcp_factor_view> view;
      mlcp_factor_view_init(&view, sizeof(mlcp_factor_view));
      resize(view);
      return look(mlcp_solver_factor(s, maybe(&view)));
    }
  }
}

void Session::snapshots() {
  char message[40];
  const std::size_t room = static_cast<std::size_t>(in_.integer(0, sizeof message));
  std::size_t size = 0;
  const mlcp_problem* p = problem();
  const mlcp_solver* s = solver();
  const mlcp_mask *enabled = mask(), *start = mask();
  Bytes bytes(1 << 16);
  const mlcp_status status = mlcp_snapshot_write(p, s, enabled, start, in_.one_in(8) ? 10 : bytes.size(), bytes.data(), maybe(&size), message, room);
  look(status);
  if (status != MLCP_OK) return;
  mlcp_problem* problem = nullptr;
  mlcp_solver* solver = nullptr;
  mlcp_mask *e = nullptr, *b = nullptr;
  look(mlcp_snapshot_read(bytes.data(), size, maybe(&hooks_), maybe(&problem), maybe(&solver), maybe(&e), maybe(&b), message, room));
  if (problem) *problems_[1].fresh() = problem;
  if (solver) *solvers_[1].fresh() = solver;
  if (e) *masks_[1].fresh() = e;
  if (b) *masks_[2].fresh() = b;
}

void Session::run() {
  fuzz::require(mlcp_problem_create(&hooks_, problems_[0].fresh()) == MLCP_OK, "an object can be made");
  fuzz::require(mlcp_solver_create(nullptr, &hooks_, solvers_[0].fresh()) == MLCP_OK, "an object can be made");
  constexpr void (Session::*kinds[])() = {&Session::bodies,   &Session::rows,     &Session::bulk_rows, &Session::values, &Session::contacts,
                                          &Session::solve,    &Session::solve,    &Session::results,   &Session::masks,  &Session::read_back,
                                          &Session::timestep, &Session::snapshots, &Session::objects};
  for (int steps = 0; !in_.empty() && steps < 200; ++steps) {
    const int choice = in_.byte();
    if (choice >= 250) allocator_.left = in_.integer(0, 40);
    else if (choice >= 235) allocator_.left = Allocator::never;
    else (this->*kinds[choice % std::size(kinds)])();
    arrays_.clear();
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in(data, size);
  Session(in).run();
  return 0;
}
