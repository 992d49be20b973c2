"""ODE's Dantzig solver, as DART packages it: dense, without a tolerance."""
from .native import NativePeer, debian_version, help_with_ties


class Peer(NativePeer):
    name, library = "ODE Dantzig", "ode"
    settings = help_with_ties(nudge=1e-14, softness=1e-10)

    @staticmethod
    def version():
        return debian_version("libdart-external-odelcpsolver-dev")
