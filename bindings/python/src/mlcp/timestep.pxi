"""The functions of mlcp_timestep_*; the one for momentum is Problem.set_timestep_momentum."""

def timestep_rows(double h, phi, phi_t=None, *, double stabilisation=0.2, bint unilateral=True):
    """r of constraint rows: −(K/h) φ − ∂φ/∂t.

    Parameters
    ----------
    h : float
        Step, s, > 0.
    phi : (count,) array
        Constraint values, m: the gap of a contact, the error of a joint.
    phi_t : (count,) array, optional
        Their partial time derivatives, m/s; None: 0.
    stabilisation : float
        K in 0 … 1, for joints and for contacts that overlap. An open gap has K = 1: it may close fully, not more.
    unilateral : bool
        Whether the rows are contacts.

    Returns
    -------
    (count,) array
        r, m/s.
    """
    cdef cnp.ndarray value = doubles(phi, "phi", -1)
    cdef cnp.ndarray rate = None if phi_t is None else doubles(phi_t, "phi_t", value.shape[0])
    cdef cnp.ndarray r = np.empty(value.shape[0])
    if mlcp_timestep_rows(h, stabilisation, unilateral, size32(value.shape[0], "length of phi"), f64(value), f64(rate), f64(r)):
        raise errors.ArgumentError(f"h = {h}, stabilisation = {stabilisation} or an entry of phi or phi_t is not legal")
    return r


def timestep_restitution(double h, r, phi, rate, restitution, phi_t=None, *, double slowest=0.0):
    """r of contacts that bounce, by Newton's law: max(r, −e dφ/dt − ∂φ/∂t) where φ + h dφ/dt ≤ 0 and dφ/dt < −slowest.

    Parameters
    ----------
    h : float
        Step, s, > 0.
    r, phi, phi_t : (count,) arrays
        As `timestep_rows` gives and takes them; phi_t None: 0.
    rate : (count,) array
        dφ/dt before the step, m/s: J v + ∂φ/∂t.
    restitution : (count,) array or float
        e in 0 … 1.
    slowest : float
        m/s; slower contacts do not bounce.

    Returns
    -------
    (count,) array
        The new r, m/s.
    """
    cdef cnp.ndarray result = doubles(r, "r", -1).copy()
    cdef cnp.ndarray gap = doubles(phi, "phi", result.shape[0])
    cdef cnp.ndarray before = doubles(rate, "rate", result.shape[0])
    cdef cnp.ndarray e = doubles(np.broadcast_to(restitution, result.shape[0]), "restitution", result.shape[0])
    cdef cnp.ndarray moved = None if phi_t is None else doubles(phi_t, "phi_t", result.shape[0])
    if mlcp_timestep_restitution(h, slowest, size32(result.shape[0], "length of r"), f64(e), f64(gap), f64(before), f64(moved), f64(result)):
        raise errors.ArgumentError(f"h = {h}, slowest = {slowest} or an entry of restitution, phi, rate, phi_t or r is not legal")
    return result


def timestep_spring(double h, double stiffness, double damping, double phi):
    """Compliance and r of a spring (N/m) and damper (N·s/m), integrated implicitly: 1/(h(h s + d)) and −s φ/(h s + d)."""
    cdef double compliance = 0, r = 0
    if mlcp_timestep_spring(h, stiffness, damping, phi, &compliance, &r):
        raise errors.ArgumentError(f"h = {h}, stiffness = {stiffness}, damping = {damping}, phi = {phi}: not a legal spring")
    return compliance, r


def timestep_erp_cfm(double h, double erp, double cfm, double phi):
    """Compliance and r the way of ODE and Bullet: cfm/h and −(erp/h) φ."""
    cdef double compliance = 0, r = 0
    if mlcp_timestep_erp_cfm(h, erp, cfm, phi, &compliance, &r):
        raise errors.ArgumentError(f"h = {h}, erp = {erp}, cfm = {cfm}, phi = {phi}: not legal")
    return compliance, r
