"""Bullet's Dantzig solver: dense, single precision as it is distributed."""
from .native import NativePeer, debian_version, help_with_ties


class Peer(NativePeer):
    name, library = "Bullet Dantzig", "bullet"
    settings = help_with_ties(nudge=1e-7, softness=1e-5)

    @staticmethod
    def version():
        return debian_version("libbullet-dev")
