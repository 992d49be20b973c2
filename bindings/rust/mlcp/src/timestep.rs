//! Right-hand sides of a time step; [`Problem::set_momentum_of_step`](crate::Problem::set_momentum_of_step) is the one for momenta.
use crate::error::{Result, check};
use crate::numbers::{check_length, int};

/// What a soft row is made of: [`Rows::compliance`](crate::Rows::compliance) and [`Rows::r`](crate::Rows::r).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftRow {
    /// The diagonal entry of Σ, m/(N·s).
    pub compliance: f64,
    /// The right-hand side, m/s.
    pub r: f64,
}

/// r of constraint rows, equation (2.5) of the paper: `rᵢ = −(K/h) φᵢ − ∂φᵢ/∂t`, m/s. K = 1 for a unilateral row with an open gap, so that
/// the gap may close fully but not more; otherwise `stabilisation`, 0 to 1. `phi`: values of the constraints, m; `phi_t`: their partial
/// derivatives in time, m/s, `None` for 0.
///
/// ```
/// # fn main() -> mlcp::Result<()> {
/// let mut r = [0.0; 2];
/// mlcp::timestep::rows(0.5, 0.2, true, &[1.0, -1.0], None, &mut r)?;
/// assert_eq!(r, [-2.0, 0.4]);
/// # Ok(()) }
/// ```
pub fn rows(h: f64, stabilisation: f64, unilateral: bool, phi: &[f64], phi_t: Option<&[f64]>, r: &mut [f64]) -> Result<()> {
    check_length("phi_t", phi_t.map_or(phi.len(), <[f64]>::len), phi.len())?;
    check_length("r", r.len(), phi.len())?;
    let count = int("the length of phi", phi.len())?;
    let phi_t = phi_t.map_or(std::ptr::null(), <[f64]>::as_ptr);
    // SAFETY: `count` numbers in each array that there is.
    check(unsafe { sys::mlcp_timestep_rows(h, stabilisation, i32::from(unilateral), count, phi.as_ptr(), phi_t, r.as_mut_ptr()) })
}

/// Newton's law of restitution for unilateral rows, after [`rows`]: where `φᵢ + h rateᵢ ≤ 0` and `rateᵢ < −slowest`, `rᵢ` becomes
/// `max(rᵢ, −restitutionᵢ rateᵢ − ∂φᵢ/∂t)`. `rate`: dφ/dt before the step, m/s, that is `J v + ∂φ/∂t`; `restitution`: 0 to 1.
pub fn restitution(
    h: f64,
    slowest: f64,
    restitution: &[f64],
    phi: &[f64],
    rate: &[f64],
    phi_t: Option<&[f64]>,
    r: &mut [f64],
) -> Result<()> {
    check_length("restitution", restitution.len(), phi.len())?;
    check_length("rate", rate.len(), phi.len())?;
    check_length("phi_t", phi_t.map_or(phi.len(), <[f64]>::len), phi.len())?;
    check_length("r", r.len(), phi.len())?;
    let count = int("the length of phi", phi.len())?;
    let phi_t = phi_t.map_or(std::ptr::null(), <[f64]>::as_ptr);
    let (e, phi, rate, r) = (restitution.as_ptr(), phi.as_ptr(), rate.as_ptr(), r.as_mut_ptr());
    // SAFETY: `count` numbers in each array that there is.
    check(unsafe { sys::mlcp_timestep_restitution(h, slowest, count, e, phi, rate, phi_t, r) })
}

/// A spring (`stiffness` s ≥ 0, N/m) and damper (`damping` d ≥ 0, N·s/m), not both 0, integrated implicitly over a step of `h` seconds:
/// `Σ = 1 / (h (h s + d))`, `r = −s φ / (h s + d)`.
pub fn spring(h: f64, stiffness: f64, damping: f64, phi: f64) -> Result<SoftRow> {
    let mut row = SoftRow { compliance: 0.0, r: 0.0 };
    // SAFETY: places for both numbers.
    check(unsafe { sys::mlcp_timestep_spring(h, stiffness, damping, phi, &mut row.compliance, &mut row.r) })?;
    Ok(row)
}

/// The way of ODE and Bullet: `Σ = cfm / h`, `r = −(erp / h) φ`; `cfm` ≥ 0 as a compliance on forces, 0 ≤ `erp` ≤ 1.
pub fn erp_cfm(h: f64, erp: f64, cfm: f64, phi: f64) -> Result<SoftRow> {
    let mut row = SoftRow { compliance: 0.0, r: 0.0 };
    // SAFETY: places for both numbers.
    check(unsafe { sys::mlcp_timestep_erp_cfm(h, erp, cfm, phi, &mut row.compliance, &mut row.r) })?;
    Ok(row)
}
