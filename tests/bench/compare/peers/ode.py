"""ODE's Dantzig solver, as DART packages it: dense, without a tolerance."""
from .native import NativePeer, debian_version


class Peer(NativePeer):
    name, library = "ODE Dantzig", "ode"

    @staticmethod
    def version():
        return debian_version("libdart-external-odelcpsolver-dev")
