"""qpOASES: an online active-set method, dense, on the form with bounds only."""
import importlib.metadata

from .native import NativePeer


class Peer(NativePeer):
    name, library = "qpOASES", "qpoases"

    @staticmethod
    def version():
        return importlib.metadata.version("cmeel-qpoases")
