"""Bullet's Dantzig solver: dense, single precision as it is distributed."""
from .native import NativePeer, debian_version


class Peer(NativePeer):
    name, library = "Bullet Dantzig", "bullet"

    @staticmethod
    def version():
        return debian_version("libbullet-dev")
