pub const MLCP_ABI_VERSION: i32 = 0;
pub const MLCP_WORLD: i32 = -1;
pub type mlcp_status = i32;
pub const MLCP_OK: mlcp_status = 0;
pub const MLCP_ERROR_NULL: mlcp_status = 1;
pub const MLCP_ERROR_ARGUMENT: mlcp_status = 2;
pub const MLCP_ERROR_RANGE: mlcp_status = 3;
pub const MLCP_ERROR_STATE: mlcp_status = 4;
pub const MLCP_ERROR_OUT_OF_MEMORY: mlcp_status = 5;
pub const MLCP_ERROR_IO: mlcp_status = 6;
pub const MLCP_ERROR_FORMAT: mlcp_status = 7;
pub const MLCP_ERROR_UNSUPPORTED: mlcp_status = 8;
pub const MLCP_ERROR_INTERNAL: mlcp_status = 9;
pub type mlcp_outcome = i32;
pub const MLCP_SOLVED: mlcp_outcome = 0;
pub const MLCP_ITERATION_LIMIT: mlcp_outcome = 1;
pub const MLCP_WORK_LIMIT: mlcp_outcome = 2;
pub const MLCP_TIME_LIMIT: mlcp_outcome = 3;
pub const MLCP_INTERRUPTED: mlcp_outcome = 4;
pub const MLCP_INFEASIBLE: mlcp_outcome = 5;
pub const MLCP_UNBOUNDED: mlcp_outcome = 6;
pub const MLCP_NOT_POSITIVE_DEFINITE: mlcp_outcome = 7;
pub const MLCP_BAD_INPUT: mlcp_outcome = 8;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_allocator {
    pub context: *mut ::core::ffi::c_void,
    pub reallocate: ::core::option::Option<
        unsafe extern "C" fn(
            context: *mut ::core::ffi::c_void,
            block: *mut ::core::ffi::c_void,
            old_size: usize,
            new_size: usize,
        ) -> *mut ::core::ffi::c_void,
    >,
    pub release: ::core::option::Option<
        unsafe extern "C" fn(
            context: *mut ::core::ffi::c_void,
            block: *mut ::core::ffi::c_void,
            size: usize,
        ),
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_allocator"][::core::mem::size_of::<mlcp_allocator>() - 24usize];
    ["Alignment of mlcp_allocator"][::core::mem::align_of::<mlcp_allocator>() - 8usize];
    [
        "Offset of field: mlcp_allocator::context",
    ][::core::mem::offset_of!(mlcp_allocator, context) - 0usize];
    [
        "Offset of field: mlcp_allocator::reallocate",
    ][::core::mem::offset_of!(mlcp_allocator, reallocate) - 8usize];
    [
        "Offset of field: mlcp_allocator::release",
    ][::core::mem::offset_of!(mlcp_allocator, release) - 16usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_problem {
    _unused: [u8; 0],
}
pub type mlcp_triangle = i32;
pub const MLCP_FULL: mlcp_triangle = 0;
pub const MLCP_LOWER: mlcp_triangle = 1;
pub const MLCP_UPPER: mlcp_triangle = 2;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_rows {
    pub struct_size: usize,
    pub count: i32,
    pub body_a: *const i32,
    pub body_b: *const i32,
    pub jacobian_a: *const f64,
    pub jacobian_b: *const f64,
    pub jacobian_a_stride: isize,
    pub jacobian_b_stride: isize,
    pub r: *const f64,
    pub lo: *const f64,
    pub hi: *const f64,
    pub compliance: *const f64,
    pub key: *const u64,
    pub value_stride: isize,
    pub body_stride: isize,
    pub key_stride: isize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_rows"][::core::mem::size_of::<mlcp_rows>() - 128usize];
    ["Alignment of mlcp_rows"][::core::mem::align_of::<mlcp_rows>() - 8usize];
    [
        "Offset of field: mlcp_rows::struct_size",
    ][::core::mem::offset_of!(mlcp_rows, struct_size) - 0usize];
    [
        "Offset of field: mlcp_rows::count",
    ][::core::mem::offset_of!(mlcp_rows, count) - 8usize];
    [
        "Offset of field: mlcp_rows::body_a",
    ][::core::mem::offset_of!(mlcp_rows, body_a) - 16usize];
    [
        "Offset of field: mlcp_rows::body_b",
    ][::core::mem::offset_of!(mlcp_rows, body_b) - 24usize];
    [
        "Offset of field: mlcp_rows::jacobian_a",
    ][::core::mem::offset_of!(mlcp_rows, jacobian_a) - 32usize];
    [
        "Offset of field: mlcp_rows::jacobian_b",
    ][::core::mem::offset_of!(mlcp_rows, jacobian_b) - 40usize];
    [
        "Offset of field: mlcp_rows::jacobian_a_stride",
    ][::core::mem::offset_of!(mlcp_rows, jacobian_a_stride) - 48usize];
    [
        "Offset of field: mlcp_rows::jacobian_b_stride",
    ][::core::mem::offset_of!(mlcp_rows, jacobian_b_stride) - 56usize];
    ["Offset of field: mlcp_rows::r"][::core::mem::offset_of!(mlcp_rows, r) - 64usize];
    ["Offset of field: mlcp_rows::lo"][::core::mem::offset_of!(mlcp_rows, lo) - 72usize];
    ["Offset of field: mlcp_rows::hi"][::core::mem::offset_of!(mlcp_rows, hi) - 80usize];
    [
        "Offset of field: mlcp_rows::compliance",
    ][::core::mem::offset_of!(mlcp_rows, compliance) - 88usize];
    [
        "Offset of field: mlcp_rows::key",
    ][::core::mem::offset_of!(mlcp_rows, key) - 96usize];
    [
        "Offset of field: mlcp_rows::value_stride",
    ][::core::mem::offset_of!(mlcp_rows, value_stride) - 104usize];
    [
        "Offset of field: mlcp_rows::body_stride",
    ][::core::mem::offset_of!(mlcp_rows, body_stride) - 112usize];
    [
        "Offset of field: mlcp_rows::key_stride",
    ][::core::mem::offset_of!(mlcp_rows, key_stride) - 120usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_rows_f32 {
    pub struct_size: usize,
    pub count: i32,
    pub body_a: *const i32,
    pub body_b: *const i32,
    pub jacobian_a: *const f32,
    pub jacobian_b: *const f32,
    pub jacobian_a_stride: isize,
    pub jacobian_b_stride: isize,
    pub r: *const f32,
    pub lo: *const f32,
    pub hi: *const f32,
    pub compliance: *const f32,
    pub key: *const u64,
    pub value_stride: isize,
    pub body_stride: isize,
    pub key_stride: isize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_rows_f32"][::core::mem::size_of::<mlcp_rows_f32>() - 128usize];
    ["Alignment of mlcp_rows_f32"][::core::mem::align_of::<mlcp_rows_f32>() - 8usize];
    [
        "Offset of field: mlcp_rows_f32::struct_size",
    ][::core::mem::offset_of!(mlcp_rows_f32, struct_size) - 0usize];
    [
        "Offset of field: mlcp_rows_f32::count",
    ][::core::mem::offset_of!(mlcp_rows_f32, count) - 8usize];
    [
        "Offset of field: mlcp_rows_f32::body_a",
    ][::core::mem::offset_of!(mlcp_rows_f32, body_a) - 16usize];
    [
        "Offset of field: mlcp_rows_f32::body_b",
    ][::core::mem::offset_of!(mlcp_rows_f32, body_b) - 24usize];
    [
        "Offset of field: mlcp_rows_f32::jacobian_a",
    ][::core::mem::offset_of!(mlcp_rows_f32, jacobian_a) - 32usize];
    [
        "Offset of field: mlcp_rows_f32::jacobian_b",
    ][::core::mem::offset_of!(mlcp_rows_f32, jacobian_b) - 40usize];
    [
        "Offset of field: mlcp_rows_f32::jacobian_a_stride",
    ][::core::mem::offset_of!(mlcp_rows_f32, jacobian_a_stride) - 48usize];
    [
        "Offset of field: mlcp_rows_f32::jacobian_b_stride",
    ][::core::mem::offset_of!(mlcp_rows_f32, jacobian_b_stride) - 56usize];
    [
        "Offset of field: mlcp_rows_f32::r",
    ][::core::mem::offset_of!(mlcp_rows_f32, r) - 64usize];
    [
        "Offset of field: mlcp_rows_f32::lo",
    ][::core::mem::offset_of!(mlcp_rows_f32, lo) - 72usize];
    [
        "Offset of field: mlcp_rows_f32::hi",
    ][::core::mem::offset_of!(mlcp_rows_f32, hi) - 80usize];
    [
        "Offset of field: mlcp_rows_f32::compliance",
    ][::core::mem::offset_of!(mlcp_rows_f32, compliance) - 88usize];
    [
        "Offset of field: mlcp_rows_f32::key",
    ][::core::mem::offset_of!(mlcp_rows_f32, key) - 96usize];
    [
        "Offset of field: mlcp_rows_f32::value_stride",
    ][::core::mem::offset_of!(mlcp_rows_f32, value_stride) - 104usize];
    [
        "Offset of field: mlcp_rows_f32::body_stride",
    ][::core::mem::offset_of!(mlcp_rows_f32, body_stride) - 112usize];
    [
        "Offset of field: mlcp_rows_f32::key_stride",
    ][::core::mem::offset_of!(mlcp_rows_f32, key_stride) - 120usize];
};
pub type mlcp_friction = i32;
pub const MLCP_FRICTION_NONE: mlcp_friction = 0;
pub const MLCP_FRICTION_CONVEX: mlcp_friction = 1;
pub const MLCP_FRICTION_COULOMB: mlcp_friction = 2;
pub const MLCP_FRICTION_BOX: mlcp_friction = 3;
pub const MLCP_FRICTION_FINDEX: mlcp_friction = 4;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_contacts {
    pub struct_size: usize,
    pub count: i32,
    pub dimension: i32,
    pub body_a: *const i32,
    pub body_b: *const i32,
    pub jacobian_a: *const f64,
    pub jacobian_b: *const f64,
    pub jacobian_a_stride: isize,
    pub jacobian_b_stride: isize,
    pub r: *const f64,
    pub compliance: *const f64,
    pub mu: *const f64,
    pub bound: *const f64,
    pub model: *const mlcp_friction,
    pub facets: *const i32,
    pub key: *const u64,
    pub vector_stride: isize,
    pub value_stride: isize,
    pub choice_stride: isize,
    pub body_stride: isize,
    pub key_stride: isize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_contacts"][::core::mem::size_of::<mlcp_contacts>() - 160usize];
    ["Alignment of mlcp_contacts"][::core::mem::align_of::<mlcp_contacts>() - 8usize];
    [
        "Offset of field: mlcp_contacts::struct_size",
    ][::core::mem::offset_of!(mlcp_contacts, struct_size) - 0usize];
    [
        "Offset of field: mlcp_contacts::count",
    ][::core::mem::offset_of!(mlcp_contacts, count) - 8usize];
    [
        "Offset of field: mlcp_contacts::dimension",
    ][::core::mem::offset_of!(mlcp_contacts, dimension) - 12usize];
    [
        "Offset of field: mlcp_contacts::body_a",
    ][::core::mem::offset_of!(mlcp_contacts, body_a) - 16usize];
    [
        "Offset of field: mlcp_contacts::body_b",
    ][::core::mem::offset_of!(mlcp_contacts, body_b) - 24usize];
    [
        "Offset of field: mlcp_contacts::jacobian_a",
    ][::core::mem::offset_of!(mlcp_contacts, jacobian_a) - 32usize];
    [
        "Offset of field: mlcp_contacts::jacobian_b",
    ][::core::mem::offset_of!(mlcp_contacts, jacobian_b) - 40usize];
    [
        "Offset of field: mlcp_contacts::jacobian_a_stride",
    ][::core::mem::offset_of!(mlcp_contacts, jacobian_a_stride) - 48usize];
    [
        "Offset of field: mlcp_contacts::jacobian_b_stride",
    ][::core::mem::offset_of!(mlcp_contacts, jacobian_b_stride) - 56usize];
    [
        "Offset of field: mlcp_contacts::r",
    ][::core::mem::offset_of!(mlcp_contacts, r) - 64usize];
    [
        "Offset of field: mlcp_contacts::compliance",
    ][::core::mem::offset_of!(mlcp_contacts, compliance) - 72usize];
    [
        "Offset of field: mlcp_contacts::mu",
    ][::core::mem::offset_of!(mlcp_contacts, mu) - 80usize];
    [
        "Offset of field: mlcp_contacts::bound",
    ][::core::mem::offset_of!(mlcp_contacts, bound) - 88usize];
    [
        "Offset of field: mlcp_contacts::model",
    ][::core::mem::offset_of!(mlcp_contacts, model) - 96usize];
    [
        "Offset of field: mlcp_contacts::facets",
    ][::core::mem::offset_of!(mlcp_contacts, facets) - 104usize];
    [
        "Offset of field: mlcp_contacts::key",
    ][::core::mem::offset_of!(mlcp_contacts, key) - 112usize];
    [
        "Offset of field: mlcp_contacts::vector_stride",
    ][::core::mem::offset_of!(mlcp_contacts, vector_stride) - 120usize];
    [
        "Offset of field: mlcp_contacts::value_stride",
    ][::core::mem::offset_of!(mlcp_contacts, value_stride) - 128usize];
    [
        "Offset of field: mlcp_contacts::choice_stride",
    ][::core::mem::offset_of!(mlcp_contacts, choice_stride) - 136usize];
    [
        "Offset of field: mlcp_contacts::body_stride",
    ][::core::mem::offset_of!(mlcp_contacts, body_stride) - 144usize];
    [
        "Offset of field: mlcp_contacts::key_stride",
    ][::core::mem::offset_of!(mlcp_contacts, key_stride) - 152usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_contacts_f32 {
    pub struct_size: usize,
    pub count: i32,
    pub dimension: i32,
    pub body_a: *const i32,
    pub body_b: *const i32,
    pub jacobian_a: *const f32,
    pub jacobian_b: *const f32,
    pub jacobian_a_stride: isize,
    pub jacobian_b_stride: isize,
    pub r: *const f32,
    pub compliance: *const f32,
    pub mu: *const f32,
    pub bound: *const f32,
    pub model: *const mlcp_friction,
    pub facets: *const i32,
    pub key: *const u64,
    pub vector_stride: isize,
    pub value_stride: isize,
    pub choice_stride: isize,
    pub body_stride: isize,
    pub key_stride: isize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    [
        "Size of mlcp_contacts_f32",
    ][::core::mem::size_of::<mlcp_contacts_f32>() - 160usize];
    [
        "Alignment of mlcp_contacts_f32",
    ][::core::mem::align_of::<mlcp_contacts_f32>() - 8usize];
    [
        "Offset of field: mlcp_contacts_f32::struct_size",
    ][::core::mem::offset_of!(mlcp_contacts_f32, struct_size) - 0usize];
    [
        "Offset of field: mlcp_contacts_f32::count",
    ][::core::mem::offset_of!(mlcp_contacts_f32, count) - 8usize];
    [
        "Offset of field: mlcp_contacts_f32::dimension",
    ][::core::mem::offset_of!(mlcp_contacts_f32, dimension) - 12usize];
    [
        "Offset of field: mlcp_contacts_f32::body_a",
    ][::core::mem::offset_of!(mlcp_contacts_f32, body_a) - 16usize];
    [
        "Offset of field: mlcp_contacts_f32::body_b",
    ][::core::mem::offset_of!(mlcp_contacts_f32, body_b) - 24usize];
    [
        "Offset of field: mlcp_contacts_f32::jacobian_a",
    ][::core::mem::offset_of!(mlcp_contacts_f32, jacobian_a) - 32usize];
    [
        "Offset of field: mlcp_contacts_f32::jacobian_b",
    ][::core::mem::offset_of!(mlcp_contacts_f32, jacobian_b) - 40usize];
    [
        "Offset of field: mlcp_contacts_f32::jacobian_a_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, jacobian_a_stride) - 48usize];
    [
        "Offset of field: mlcp_contacts_f32::jacobian_b_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, jacobian_b_stride) - 56usize];
    [
        "Offset of field: mlcp_contacts_f32::r",
    ][::core::mem::offset_of!(mlcp_contacts_f32, r) - 64usize];
    [
        "Offset of field: mlcp_contacts_f32::compliance",
    ][::core::mem::offset_of!(mlcp_contacts_f32, compliance) - 72usize];
    [
        "Offset of field: mlcp_contacts_f32::mu",
    ][::core::mem::offset_of!(mlcp_contacts_f32, mu) - 80usize];
    [
        "Offset of field: mlcp_contacts_f32::bound",
    ][::core::mem::offset_of!(mlcp_contacts_f32, bound) - 88usize];
    [
        "Offset of field: mlcp_contacts_f32::model",
    ][::core::mem::offset_of!(mlcp_contacts_f32, model) - 96usize];
    [
        "Offset of field: mlcp_contacts_f32::facets",
    ][::core::mem::offset_of!(mlcp_contacts_f32, facets) - 104usize];
    [
        "Offset of field: mlcp_contacts_f32::key",
    ][::core::mem::offset_of!(mlcp_contacts_f32, key) - 112usize];
    [
        "Offset of field: mlcp_contacts_f32::vector_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, vector_stride) - 120usize];
    [
        "Offset of field: mlcp_contacts_f32::value_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, value_stride) - 128usize];
    [
        "Offset of field: mlcp_contacts_f32::choice_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, choice_stride) - 136usize];
    [
        "Offset of field: mlcp_contacts_f32::body_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, body_stride) - 144usize];
    [
        "Offset of field: mlcp_contacts_f32::key_stride",
    ][::core::mem::offset_of!(mlcp_contacts_f32, key_stride) - 152usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_matrix_view {
    pub struct_size: usize,
    pub rows: i32,
    pub columns: i32,
    pub entries: i64,
    pub pointers: *const i32,
    pub indices: *const i32,
    pub values: *const f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_matrix_view"][::core::mem::size_of::<mlcp_matrix_view>() - 48usize];
    [
        "Alignment of mlcp_matrix_view",
    ][::core::mem::align_of::<mlcp_matrix_view>() - 8usize];
    [
        "Offset of field: mlcp_matrix_view::struct_size",
    ][::core::mem::offset_of!(mlcp_matrix_view, struct_size) - 0usize];
    [
        "Offset of field: mlcp_matrix_view::rows",
    ][::core::mem::offset_of!(mlcp_matrix_view, rows) - 8usize];
    [
        "Offset of field: mlcp_matrix_view::columns",
    ][::core::mem::offset_of!(mlcp_matrix_view, columns) - 12usize];
    [
        "Offset of field: mlcp_matrix_view::entries",
    ][::core::mem::offset_of!(mlcp_matrix_view, entries) - 16usize];
    [
        "Offset of field: mlcp_matrix_view::pointers",
    ][::core::mem::offset_of!(mlcp_matrix_view, pointers) - 24usize];
    [
        "Offset of field: mlcp_matrix_view::indices",
    ][::core::mem::offset_of!(mlcp_matrix_view, indices) - 32usize];
    [
        "Offset of field: mlcp_matrix_view::values",
    ][::core::mem::offset_of!(mlcp_matrix_view, values) - 40usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_mask {
    _unused: [u8; 0],
}
pub type mlcp_row_state = u8;
pub const MLCP_ROW_DISABLED: mlcp_row_state = 0;
pub const MLCP_ROW_AT_LOWER: mlcp_row_state = 1;
pub const MLCP_ROW_ACTIVE: mlcp_row_state = 2;
pub const MLCP_ROW_AT_UPPER: mlcp_row_state = 3;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_solver {
    _unused: [u8; 0],
}
pub type mlcp_method = i32;
pub const MLCP_METHOD_AUTO: mlcp_method = 0;
pub const MLCP_METHOD_SIMPLEX: mlcp_method = 1;
pub const MLCP_METHOD_NEWTON: mlcp_method = 2;
pub const MLCP_METHOD_PGS: mlcp_method = 3;
pub type mlcp_pivot_rule = i32;
pub const MLCP_PIVOT_DUAL: mlcp_pivot_rule = 0;
pub const MLCP_PIVOT_PRINTED: mlcp_pivot_rule = 1;
pub type mlcp_refactorize = i32;
pub const MLCP_REFACTORIZE_WHEN_NEEDED: mlcp_refactorize = 0;
pub const MLCP_REFACTORIZE_ALWAYS: mlcp_refactorize = 1;
pub type mlcp_impulses = i32;
pub const MLCP_IMPULSES_ANY: mlcp_impulses = 0;
pub const MLCP_IMPULSES_LEAST_NORM: mlcp_impulses = 1;
pub type mlcp_task = ::core::option::Option<
    unsafe extern "C" fn(data: *mut ::core::ffi::c_void, index: i32, worker: i32),
>;
pub type mlcp_parallel_for = ::core::option::Option<
    unsafe extern "C" fn(
        context: *mut ::core::ffi::c_void,
        count: i32,
        task: mlcp_task,
        data: *mut ::core::ffi::c_void,
    ),
>;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_progress {
    pub struct_size: usize,
    pub seconds: f64,
    pub pivots: i64,
    pub work: i64,
    pub island: i32,
    pub islands: i32,
    pub violation: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_progress"][::core::mem::size_of::<mlcp_progress>() - 48usize];
    ["Alignment of mlcp_progress"][::core::mem::align_of::<mlcp_progress>() - 8usize];
    [
        "Offset of field: mlcp_progress::struct_size",
    ][::core::mem::offset_of!(mlcp_progress, struct_size) - 0usize];
    [
        "Offset of field: mlcp_progress::seconds",
    ][::core::mem::offset_of!(mlcp_progress, seconds) - 8usize];
    [
        "Offset of field: mlcp_progress::pivots",
    ][::core::mem::offset_of!(mlcp_progress, pivots) - 16usize];
    [
        "Offset of field: mlcp_progress::work",
    ][::core::mem::offset_of!(mlcp_progress, work) - 24usize];
    [
        "Offset of field: mlcp_progress::island",
    ][::core::mem::offset_of!(mlcp_progress, island) - 32usize];
    [
        "Offset of field: mlcp_progress::islands",
    ][::core::mem::offset_of!(mlcp_progress, islands) - 36usize];
    [
        "Offset of field: mlcp_progress::violation",
    ][::core::mem::offset_of!(mlcp_progress, violation) - 40usize];
};
pub type mlcp_progress_callback = ::core::option::Option<
    unsafe extern "C" fn(
        context: *mut ::core::ffi::c_void,
        progress: *const mlcp_progress,
    ) -> i32,
>;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_settings {
    pub struct_size: usize,
    pub method: mlcp_method,
    pub pivot_rule: mlcp_pivot_rule,
    pub refactorize: mlcp_refactorize,
    pub trace: i32,
    pub tolerance: f64,
    pub max_iterations: i64,
    pub max_work: i64,
    pub max_seconds: f64,
    pub progress: mlcp_progress_callback,
    pub progress_context: *mut ::core::ffi::c_void,
    pub impulses: mlcp_impulses,
    pub canonical: i32,
    pub warm_start: i32,
    pub num_threads: i32,
    pub parallel_for: mlcp_parallel_for,
    pub parallel_context: *mut ::core::ffi::c_void,
    pub facets: i32,
    pub max_shifts: i32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_settings"][::core::mem::size_of::<mlcp_settings>() - 112usize];
    ["Alignment of mlcp_settings"][::core::mem::align_of::<mlcp_settings>() - 8usize];
    [
        "Offset of field: mlcp_settings::struct_size",
    ][::core::mem::offset_of!(mlcp_settings, struct_size) - 0usize];
    [
        "Offset of field: mlcp_settings::method",
    ][::core::mem::offset_of!(mlcp_settings, method) - 8usize];
    [
        "Offset of field: mlcp_settings::pivot_rule",
    ][::core::mem::offset_of!(mlcp_settings, pivot_rule) - 12usize];
    [
        "Offset of field: mlcp_settings::refactorize",
    ][::core::mem::offset_of!(mlcp_settings, refactorize) - 16usize];
    [
        "Offset of field: mlcp_settings::trace",
    ][::core::mem::offset_of!(mlcp_settings, trace) - 20usize];
    [
        "Offset of field: mlcp_settings::tolerance",
    ][::core::mem::offset_of!(mlcp_settings, tolerance) - 24usize];
    [
        "Offset of field: mlcp_settings::max_iterations",
    ][::core::mem::offset_of!(mlcp_settings, max_iterations) - 32usize];
    [
        "Offset of field: mlcp_settings::max_work",
    ][::core::mem::offset_of!(mlcp_settings, max_work) - 40usize];
    [
        "Offset of field: mlcp_settings::max_seconds",
    ][::core::mem::offset_of!(mlcp_settings, max_seconds) - 48usize];
    [
        "Offset of field: mlcp_settings::progress",
    ][::core::mem::offset_of!(mlcp_settings, progress) - 56usize];
    [
        "Offset of field: mlcp_settings::progress_context",
    ][::core::mem::offset_of!(mlcp_settings, progress_context) - 64usize];
    [
        "Offset of field: mlcp_settings::impulses",
    ][::core::mem::offset_of!(mlcp_settings, impulses) - 72usize];
    [
        "Offset of field: mlcp_settings::canonical",
    ][::core::mem::offset_of!(mlcp_settings, canonical) - 76usize];
    [
        "Offset of field: mlcp_settings::warm_start",
    ][::core::mem::offset_of!(mlcp_settings, warm_start) - 80usize];
    [
        "Offset of field: mlcp_settings::num_threads",
    ][::core::mem::offset_of!(mlcp_settings, num_threads) - 84usize];
    [
        "Offset of field: mlcp_settings::parallel_for",
    ][::core::mem::offset_of!(mlcp_settings, parallel_for) - 88usize];
    [
        "Offset of field: mlcp_settings::parallel_context",
    ][::core::mem::offset_of!(mlcp_settings, parallel_context) - 96usize];
    [
        "Offset of field: mlcp_settings::facets",
    ][::core::mem::offset_of!(mlcp_settings, facets) - 104usize];
    [
        "Offset of field: mlcp_settings::max_shifts",
    ][::core::mem::offset_of!(mlcp_settings, max_shifts) - 108usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_report {
    pub struct_size: usize,
    pub outcome: mlcp_outcome,
    pub method: mlcp_method,
    pub momentum_error: f64,
    pub constraint_error: f64,
    pub largest_error: f64,
    pub momentum_residual: f64,
    pub constraint_residual: f64,
    pub worst_velocity: i32,
    pub worst_row: i32,
    pub worst_body: i32,
    pub islands: i32,
    pub islands_failed: i32,
    pub enabled_rows: i32,
    pub active_rows: i32,
    pub redundant_rows: i32,
    pub pivots: i64,
    pub toggles: i64,
    pub factorizations: i64,
    pub refinements: i64,
    pub work: i64,
    pub factor_entries: i64,
    pub seconds: f64,
    pub seconds_analyze: f64,
    pub seconds_factorize: f64,
    pub seconds_solve: f64,
    pub seconds_report: f64,
    pub analyzed: i32,
    pub refactorized_for_drift: i32,
    pub warm: i32,
    pub fallbacks: i32,
    pub cone_error: f64,
    pub cone_residual: f64,
    pub worst_contact: i32,
    pub contacts_open: i32,
    pub contacts_sticking: i32,
    pub contacts_sliding: i32,
    pub generators: i32,
    pub facets: i32,
    pub shift_iterations: i32,
    pub islands_by_lemke: i32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_report"][::core::mem::size_of::<mlcp_report>() - 240usize];
    ["Alignment of mlcp_report"][::core::mem::align_of::<mlcp_report>() - 8usize];
    [
        "Offset of field: mlcp_report::struct_size",
    ][::core::mem::offset_of!(mlcp_report, struct_size) - 0usize];
    [
        "Offset of field: mlcp_report::outcome",
    ][::core::mem::offset_of!(mlcp_report, outcome) - 8usize];
    [
        "Offset of field: mlcp_report::method",
    ][::core::mem::offset_of!(mlcp_report, method) - 12usize];
    [
        "Offset of field: mlcp_report::momentum_error",
    ][::core::mem::offset_of!(mlcp_report, momentum_error) - 16usize];
    [
        "Offset of field: mlcp_report::constraint_error",
    ][::core::mem::offset_of!(mlcp_report, constraint_error) - 24usize];
    [
        "Offset of field: mlcp_report::largest_error",
    ][::core::mem::offset_of!(mlcp_report, largest_error) - 32usize];
    [
        "Offset of field: mlcp_report::momentum_residual",
    ][::core::mem::offset_of!(mlcp_report, momentum_residual) - 40usize];
    [
        "Offset of field: mlcp_report::constraint_residual",
    ][::core::mem::offset_of!(mlcp_report, constraint_residual) - 48usize];
    [
        "Offset of field: mlcp_report::worst_velocity",
    ][::core::mem::offset_of!(mlcp_report, worst_velocity) - 56usize];
    [
        "Offset of field: mlcp_report::worst_row",
    ][::core::mem::offset_of!(mlcp_report, worst_row) - 60usize];
    [
        "Offset of field: mlcp_report::worst_body",
    ][::core::mem::offset_of!(mlcp_report, worst_body) - 64usize];
    [
        "Offset of field: mlcp_report::islands",
    ][::core::mem::offset_of!(mlcp_report, islands) - 68usize];
    [
        "Offset of field: mlcp_report::islands_failed",
    ][::core::mem::offset_of!(mlcp_report, islands_failed) - 72usize];
    [
        "Offset of field: mlcp_report::enabled_rows",
    ][::core::mem::offset_of!(mlcp_report, enabled_rows) - 76usize];
    [
        "Offset of field: mlcp_report::active_rows",
    ][::core::mem::offset_of!(mlcp_report, active_rows) - 80usize];
    [
        "Offset of field: mlcp_report::redundant_rows",
    ][::core::mem::offset_of!(mlcp_report, redundant_rows) - 84usize];
    [
        "Offset of field: mlcp_report::pivots",
    ][::core::mem::offset_of!(mlcp_report, pivots) - 88usize];
    [
        "Offset of field: mlcp_report::toggles",
    ][::core::mem::offset_of!(mlcp_report, toggles) - 96usize];
    [
        "Offset of field: mlcp_report::factorizations",
    ][::core::mem::offset_of!(mlcp_report, factorizations) - 104usize];
    [
        "Offset of field: mlcp_report::refinements",
    ][::core::mem::offset_of!(mlcp_report, refinements) - 112usize];
    [
        "Offset of field: mlcp_report::work",
    ][::core::mem::offset_of!(mlcp_report, work) - 120usize];
    [
        "Offset of field: mlcp_report::factor_entries",
    ][::core::mem::offset_of!(mlcp_report, factor_entries) - 128usize];
    [
        "Offset of field: mlcp_report::seconds",
    ][::core::mem::offset_of!(mlcp_report, seconds) - 136usize];
    [
        "Offset of field: mlcp_report::seconds_analyze",
    ][::core::mem::offset_of!(mlcp_report, seconds_analyze) - 144usize];
    [
        "Offset of field: mlcp_report::seconds_factorize",
    ][::core::mem::offset_of!(mlcp_report, seconds_factorize) - 152usize];
    [
        "Offset of field: mlcp_report::seconds_solve",
    ][::core::mem::offset_of!(mlcp_report, seconds_solve) - 160usize];
    [
        "Offset of field: mlcp_report::seconds_report",
    ][::core::mem::offset_of!(mlcp_report, seconds_report) - 168usize];
    [
        "Offset of field: mlcp_report::analyzed",
    ][::core::mem::offset_of!(mlcp_report, analyzed) - 176usize];
    [
        "Offset of field: mlcp_report::refactorized_for_drift",
    ][::core::mem::offset_of!(mlcp_report, refactorized_for_drift) - 180usize];
    [
        "Offset of field: mlcp_report::warm",
    ][::core::mem::offset_of!(mlcp_report, warm) - 184usize];
    [
        "Offset of field: mlcp_report::fallbacks",
    ][::core::mem::offset_of!(mlcp_report, fallbacks) - 188usize];
    [
        "Offset of field: mlcp_report::cone_error",
    ][::core::mem::offset_of!(mlcp_report, cone_error) - 192usize];
    [
        "Offset of field: mlcp_report::cone_residual",
    ][::core::mem::offset_of!(mlcp_report, cone_residual) - 200usize];
    [
        "Offset of field: mlcp_report::worst_contact",
    ][::core::mem::offset_of!(mlcp_report, worst_contact) - 208usize];
    [
        "Offset of field: mlcp_report::contacts_open",
    ][::core::mem::offset_of!(mlcp_report, contacts_open) - 212usize];
    [
        "Offset of field: mlcp_report::contacts_sticking",
    ][::core::mem::offset_of!(mlcp_report, contacts_sticking) - 216usize];
    [
        "Offset of field: mlcp_report::contacts_sliding",
    ][::core::mem::offset_of!(mlcp_report, contacts_sliding) - 220usize];
    [
        "Offset of field: mlcp_report::generators",
    ][::core::mem::offset_of!(mlcp_report, generators) - 224usize];
    [
        "Offset of field: mlcp_report::facets",
    ][::core::mem::offset_of!(mlcp_report, facets) - 228usize];
    [
        "Offset of field: mlcp_report::shift_iterations",
    ][::core::mem::offset_of!(mlcp_report, shift_iterations) - 232usize];
    [
        "Offset of field: mlcp_report::islands_by_lemke",
    ][::core::mem::offset_of!(mlcp_report, islands_by_lemke) - 236usize];
};
pub type mlcp_contact_state = u8;
pub const MLCP_CONTACT_DISABLED: mlcp_contact_state = 0;
pub const MLCP_CONTACT_OPEN: mlcp_contact_state = 1;
pub const MLCP_CONTACT_STICKING: mlcp_contact_state = 2;
pub const MLCP_CONTACT_SLIDING: mlcp_contact_state = 3;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_factor_view {
    pub struct_size: usize,
    pub size: i32,
    pub entries: i64,
    pub nodes: *const i32,
    pub pointers: *const i64,
    pub rows: *const i32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_factor_view"][::core::mem::size_of::<mlcp_factor_view>() - 48usize];
    [
        "Alignment of mlcp_factor_view",
    ][::core::mem::align_of::<mlcp_factor_view>() - 8usize];
    [
        "Offset of field: mlcp_factor_view::struct_size",
    ][::core::mem::offset_of!(mlcp_factor_view, struct_size) - 0usize];
    [
        "Offset of field: mlcp_factor_view::size",
    ][::core::mem::offset_of!(mlcp_factor_view, size) - 8usize];
    [
        "Offset of field: mlcp_factor_view::entries",
    ][::core::mem::offset_of!(mlcp_factor_view, entries) - 16usize];
    [
        "Offset of field: mlcp_factor_view::nodes",
    ][::core::mem::offset_of!(mlcp_factor_view, nodes) - 24usize];
    [
        "Offset of field: mlcp_factor_view::pointers",
    ][::core::mem::offset_of!(mlcp_factor_view, pointers) - 32usize];
    [
        "Offset of field: mlcp_factor_view::rows",
    ][::core::mem::offset_of!(mlcp_factor_view, rows) - 40usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct mlcp_pivot {
    pub island: i32,
    pub entering: i32,
    pub blocking: i32,
    pub to: mlcp_row_state,
    pub dependent: u8,
    pub step: f64,
    pub violation: f64,
    pub schur: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of mlcp_pivot"][::core::mem::size_of::<mlcp_pivot>() - 40usize];
    ["Alignment of mlcp_pivot"][::core::mem::align_of::<mlcp_pivot>() - 8usize];
    [
        "Offset of field: mlcp_pivot::island",
    ][::core::mem::offset_of!(mlcp_pivot, island) - 0usize];
    [
        "Offset of field: mlcp_pivot::entering",
    ][::core::mem::offset_of!(mlcp_pivot, entering) - 4usize];
    [
        "Offset of field: mlcp_pivot::blocking",
    ][::core::mem::offset_of!(mlcp_pivot, blocking) - 8usize];
    [
        "Offset of field: mlcp_pivot::to",
    ][::core::mem::offset_of!(mlcp_pivot, to) - 12usize];
    [
        "Offset of field: mlcp_pivot::dependent",
    ][::core::mem::offset_of!(mlcp_pivot, dependent) - 13usize];
    [
        "Offset of field: mlcp_pivot::step",
    ][::core::mem::offset_of!(mlcp_pivot, step) - 16usize];
    [
        "Offset of field: mlcp_pivot::violation",
    ][::core::mem::offset_of!(mlcp_pivot, violation) - 24usize];
    [
        "Offset of field: mlcp_pivot::schur",
    ][::core::mem::offset_of!(mlcp_pivot, schur) - 32usize];
};
unsafe extern "C" {
    pub fn mlcp_abi_version() -> i32;
    pub fn mlcp_version() -> *const ::core::ffi::c_char;
    pub fn mlcp_status_text(status: mlcp_status) -> *const ::core::ffi::c_char;
    pub fn mlcp_outcome_text(outcome: mlcp_outcome) -> *const ::core::ffi::c_char;
    pub fn mlcp_problem_create(
        allocator: *const mlcp_allocator,
        problem: *mut *mut mlcp_problem,
    ) -> mlcp_status;
    pub fn mlcp_problem_destroy(problem: *mut mlcp_problem);
    pub fn mlcp_problem_clone(
        problem: *const mlcp_problem,
        copy: *mut *mut mlcp_problem,
    ) -> mlcp_status;
    pub fn mlcp_problem_error(
        problem: *const mlcp_problem,
    ) -> *const ::core::ffi::c_char;
    pub fn mlcp_problem_velocity_count(problem: *const mlcp_problem) -> i32;
    pub fn mlcp_problem_row_count(problem: *const mlcp_problem) -> i32;
    pub fn mlcp_problem_body_count(problem: *const mlcp_problem) -> i32;
    pub fn mlcp_problem_entry_count(problem: *const mlcp_problem) -> i64;
    pub fn mlcp_problem_reserve(
        problem: *mut mlcp_problem,
        bodies: i32,
        velocities: i32,
        rows: i32,
        entries: i64,
    ) -> mlcp_status;
    pub fn mlcp_problem_trim(problem: *mut mlcp_problem) -> mlcp_status;
    pub fn mlcp_problem_clear(problem: *mut mlcp_problem) -> mlcp_status;
    pub fn mlcp_problem_bodies_add(
        problem: *mut mlcp_problem,
        count: i32,
        dimension: i32,
        masses: *const f64,
        stride_bytes: isize,
        ids: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_add_sparse(
        problem: *mut mlcp_problem,
        dimension: i32,
        column_pointers: *const i32,
        row_indices: *const i32,
        values: *const f64,
        triangle: mlcp_triangle,
        id: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_set_mass(
        problem: *mut mlcp_problem,
        body: i32,
        mass: *const f64,
        count: i64,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_remove(
        problem: *mut mlcp_problem,
        body: i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_range(
        problem: *const mlcp_problem,
        body: i32,
        offset: *mut i32,
        dimension: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_bodies(
        problem: *const mlcp_problem,
        capacity: i32,
        ids: *mut i32,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_set_prescribed(
        problem: *mut mlcp_problem,
        body: i32,
        velocity: *const f64,
        count: i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_set_dynamic(
        problem: *mut mlcp_problem,
        body: i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_body_state(
        problem: *const mlcp_problem,
        body: i32,
        prescribed: *mut i32,
        count: i32,
        velocity: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_problem_set_momentum(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        k: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_rows_init(rows: *mut mlcp_rows, struct_size: usize);
    pub fn mlcp_rows_f32_init(rows: *mut mlcp_rows_f32, struct_size: usize);
    pub fn mlcp_problem_rows_add(
        problem: *mut mlcp_problem,
        rows: *const mlcp_rows,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_add_f32(
        problem: *mut mlcp_problem,
        rows: *const mlcp_rows_f32,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_row_add(
        problem: *mut mlcp_problem,
        count: i32,
        columns: *const i32,
        values: *const f64,
        r: f64,
        lo: f64,
        hi: f64,
        compliance: f64,
        key: u64,
        index: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_add_csr(
        problem: *mut mlcp_problem,
        count: i32,
        row_pointers: *const i32,
        columns: *const i32,
        values: *const f64,
        r: *const f64,
        lo: *const f64,
        hi: *const f64,
        compliance: *const f64,
        key: *const u64,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_add_csc(
        problem: *mut mlcp_problem,
        count: i32,
        column_pointers: *const i32,
        row_indices: *const i32,
        values: *const f64,
        r: *const f64,
        lo: *const f64,
        hi: *const f64,
        compliance: *const f64,
        key: *const u64,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_set_compliance_matrix(
        problem: *mut mlcp_problem,
        count: i32,
        column_pointers: *const i32,
        row_indices: *const i32,
        values: *const f64,
        triangle: mlcp_triangle,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_set_r(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        r: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_set_bounds(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        lo: *const f64,
        hi: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_set_compliance(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        compliance: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_set_keys(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        keys: *const u64,
    ) -> mlcp_status;
    pub fn mlcp_problem_row_set_jacobian(
        problem: *mut mlcp_problem,
        row: i32,
        values: *const f64,
        count: i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_remove(
        problem: *mut mlcp_problem,
        count: i32,
        rows: *const i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_clear(problem: *mut mlcp_problem) -> mlcp_status;
    pub fn mlcp_contacts_init(contacts: *mut mlcp_contacts, struct_size: usize);
    pub fn mlcp_contacts_f32_init(contacts: *mut mlcp_contacts_f32, struct_size: usize);
    pub fn mlcp_problem_contacts_add(
        problem: *mut mlcp_problem,
        contacts: *const mlcp_contacts,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_contacts_add_f32(
        problem: *mut mlcp_problem,
        contacts: *const mlcp_contacts_f32,
        first: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_contacts_declare(
        problem: *mut mlcp_problem,
        count: i32,
        dimension: i32,
        row: *const i32,
        model: *const mlcp_friction,
        mu: *const f64,
        bound: *const f64,
        facets: *const i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_contacts_set_friction(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        model: *const mlcp_friction,
        mu: *const f64,
        bound: *const f64,
        facets: *const i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_contact_count(problem: *const mlcp_problem) -> i32;
    pub fn mlcp_problem_get_contacts(
        problem: *const mlcp_problem,
        count: i32,
        row: *mut i32,
        dimension: *mut i32,
        model: *mut mlcp_friction,
        mu: *mut f64,
        facets: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_rows_set_findex(
        problem: *mut mlcp_problem,
        first: i32,
        count: i32,
        findex: *const i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_get_findex(
        problem: *const mlcp_problem,
        count: i32,
        findex: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_problem_get_momentum(
        problem: *const mlcp_problem,
        count: i32,
        k: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_problem_get_rows(
        problem: *const mlcp_problem,
        count: i32,
        r: *mut f64,
        lo: *mut f64,
        hi: *mut f64,
        compliance: *mut f64,
        key: *mut u64,
    ) -> mlcp_status;
    pub fn mlcp_matrix_view_init(view: *mut mlcp_matrix_view, struct_size: usize);
    pub fn mlcp_problem_mass(
        problem: *const mlcp_problem,
        mass: *mut mlcp_matrix_view,
    ) -> mlcp_status;
    pub fn mlcp_problem_jacobian(
        problem: *const mlcp_problem,
        jacobian: *mut mlcp_matrix_view,
    ) -> mlcp_status;
    pub fn mlcp_problem_compliance(
        problem: *const mlcp_problem,
        compliance: *mut mlcp_matrix_view,
    ) -> mlcp_status;
    pub fn mlcp_timestep_momentum(
        problem: *mut mlcp_problem,
        h: f64,
        count: i32,
        v: *const f64,
        q: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_timestep_rows(
        h: f64,
        stabilisation: f64,
        unilateral: i32,
        count: i32,
        phi: *const f64,
        phi_t: *const f64,
        r: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_timestep_restitution(
        h: f64,
        slowest: f64,
        count: i32,
        restitution: *const f64,
        phi: *const f64,
        rate: *const f64,
        phi_t: *const f64,
        r: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_timestep_spring(
        h: f64,
        stiffness: f64,
        damping: f64,
        phi: f64,
        compliance: *mut f64,
        r: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_timestep_erp_cfm(
        h: f64,
        erp: f64,
        cfm: f64,
        phi: f64,
        compliance: *mut f64,
        r: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_mask_create(
        allocator: *const mlcp_allocator,
        count: i32,
        state: mlcp_row_state,
        mask: *mut *mut mlcp_mask,
    ) -> mlcp_status;
    pub fn mlcp_mask_destroy(mask: *mut mlcp_mask);
    pub fn mlcp_mask_clone(
        allocator: *const mlcp_allocator,
        mask: *const mlcp_mask,
        copy: *mut *mut mlcp_mask,
    ) -> mlcp_status;
    pub fn mlcp_mask_error(mask: *const mlcp_mask) -> *const ::core::ffi::c_char;
    pub fn mlcp_mask_size(mask: *const mlcp_mask) -> i32;
    pub fn mlcp_mask_resize(
        mask: *mut mlcp_mask,
        count: i32,
        state: mlcp_row_state,
    ) -> mlcp_status;
    pub fn mlcp_mask_set(
        mask: *mut mlcp_mask,
        first: i32,
        count: i32,
        states: *const mlcp_row_state,
    ) -> mlcp_status;
    pub fn mlcp_mask_get(
        mask: *const mlcp_mask,
        first: i32,
        count: i32,
        states: *mut mlcp_row_state,
    ) -> mlcp_status;
    pub fn mlcp_mask_states(mask: *const mlcp_mask) -> *const mlcp_row_state;
    pub fn mlcp_mask_count(mask: *const mlcp_mask, state: mlcp_row_state) -> i32;
    pub fn mlcp_mask_equal(a: *const mlcp_mask, b: *const mlcp_mask) -> i32;
    pub fn mlcp_mask_set_impulses(
        mask: *mut mlcp_mask,
        first: i32,
        count: i32,
        impulses: *const f64,
    ) -> mlcp_status;
    pub fn mlcp_mask_get_impulses(
        mask: *const mlcp_mask,
        first: i32,
        count: i32,
        impulses: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_mask_take_keys(
        mask: *mut mlcp_mask,
        problem: *const mlcp_problem,
    ) -> mlcp_status;
    pub fn mlcp_mask_carry(
        mask: *mut mlcp_mask,
        problem: *const mlcp_problem,
        previous: *const mlcp_mask,
        otherwise: mlcp_row_state,
    ) -> mlcp_status;
    pub fn mlcp_method_text(method: mlcp_method) -> *const ::core::ffi::c_char;
    pub fn mlcp_settings_init(settings: *mut mlcp_settings, struct_size: usize);
    pub fn mlcp_solver_create(
        settings: *const mlcp_settings,
        allocator: *const mlcp_allocator,
        solver: *mut *mut mlcp_solver,
    ) -> mlcp_status;
    pub fn mlcp_solver_destroy(solver: *mut mlcp_solver);
    pub fn mlcp_solver_set_settings(
        solver: *mut mlcp_solver,
        settings: *const mlcp_settings,
    ) -> mlcp_status;
    pub fn mlcp_solver_get_settings(
        solver: *const mlcp_solver,
        settings: *mut mlcp_settings,
    ) -> mlcp_status;
    pub fn mlcp_solver_error(solver: *const mlcp_solver) -> *const ::core::ffi::c_char;
    pub fn mlcp_solver_trim(solver: *mut mlcp_solver) -> mlcp_status;
    pub fn mlcp_report_init(report: *mut mlcp_report, struct_size: usize);
    pub fn mlcp_analyze(
        solver: *mut mlcp_solver,
        problem: *const mlcp_problem,
        enabled: *const mlcp_mask,
    ) -> mlcp_status;
    pub fn mlcp_solve(
        solver: *mut mlcp_solver,
        problem: *const mlcp_problem,
        enabled: *const mlcp_mask,
        start: *const mlcp_mask,
        report: *mut mlcp_report,
    ) -> mlcp_status;
    pub fn mlcp_solver_velocities(
        solver: *const mlcp_solver,
        v: *mut *const f64,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_impulses(
        solver: *const mlcp_solver,
        gamma: *mut *const f64,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_slacks(
        solver: *const mlcp_solver,
        w: *mut *const f64,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_mask(
        solver: *const mlcp_solver,
        mask: *mut *const mlcp_mask,
    ) -> mlcp_status;
    pub fn mlcp_solver_redundant(
        solver: *const mlcp_solver,
        redundant: *mut *const u8,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_read_velocities_f32(
        solver: *const mlcp_solver,
        count: i32,
        v: *mut f32,
        stride_bytes: isize,
    ) -> mlcp_status;
    pub fn mlcp_solver_read_impulses_f32(
        solver: *const mlcp_solver,
        count: i32,
        gamma: *mut f32,
        stride_bytes: isize,
    ) -> mlcp_status;
    pub fn mlcp_solver_contact_states(
        solver: *const mlcp_solver,
        state: *mut *const mlcp_contact_state,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_contact_facets(
        solver: *const mlcp_solver,
        facets: *mut *const i32,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_reaction(
        solver: *const mlcp_solver,
        problem: *const mlcp_problem,
        body: i32,
        count: i32,
        reaction: *mut f64,
    ) -> mlcp_status;
    pub fn mlcp_solver_row_islands(
        solver: *const mlcp_solver,
        island: *mut *const i32,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_island_outcomes(
        solver: *const mlcp_solver,
        outcome: *mut *const mlcp_outcome,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_certificate(
        solver: *const mlcp_solver,
        island: i32,
        rows: *mut *const i32,
        y: *mut *const f64,
        count: *mut i32,
    ) -> mlcp_status;
    pub fn mlcp_factor_view_init(view: *mut mlcp_factor_view, struct_size: usize);
    pub fn mlcp_solver_factor(
        solver: *const mlcp_solver,
        factor: *mut mlcp_factor_view,
    ) -> mlcp_status;
    pub fn mlcp_solver_trace(
        solver: *const mlcp_solver,
        pivots: *mut *const mlcp_pivot,
        count: *mut i64,
    ) -> mlcp_status;
    pub fn mlcp_snapshot_save(
        path: *const ::core::ffi::c_char,
        problem: *const mlcp_problem,
        solver: *const mlcp_solver,
        enabled: *const mlcp_mask,
        start: *const mlcp_mask,
        message: *mut ::core::ffi::c_char,
        message_size: usize,
    ) -> mlcp_status;
    pub fn mlcp_snapshot_write(
        problem: *const mlcp_problem,
        solver: *const mlcp_solver,
        enabled: *const mlcp_mask,
        start: *const mlcp_mask,
        capacity: usize,
        buffer: *mut ::core::ffi::c_void,
        size: *mut usize,
        message: *mut ::core::ffi::c_char,
        message_size: usize,
    ) -> mlcp_status;
    pub fn mlcp_snapshot_load(
        path: *const ::core::ffi::c_char,
        allocator: *const mlcp_allocator,
        problem: *mut *mut mlcp_problem,
        solver: *mut *mut mlcp_solver,
        enabled: *mut *mut mlcp_mask,
        start: *mut *mut mlcp_mask,
        message: *mut ::core::ffi::c_char,
        message_size: usize,
    ) -> mlcp_status;
    pub fn mlcp_snapshot_read(
        bytes: *const ::core::ffi::c_void,
        size: usize,
        allocator: *const mlcp_allocator,
        problem: *mut *mut mlcp_problem,
        solver: *mut *mut mlcp_solver,
        enabled: *mut *mut mlcp_mask,
        start: *mut *mut mlcp_mask,
        message: *mut ::core::ffi::c_char,
        message_size: usize,
    ) -> mlcp_status;
    pub fn mlcp_solver_keep_failures(
        solver: *mut mlcp_solver,
        folder: *const ::core::ffi::c_char,
        limit: i32,
    ) -> mlcp_status;
    pub fn mlcp_solver_failure_file(
        solver: *const mlcp_solver,
    ) -> *const ::core::ffi::c_char;
}
