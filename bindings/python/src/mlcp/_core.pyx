# distutils: language = c++
# cython: language_level=3, boundscheck=False, wraparound=False, initializedcheck=False
"""The classes over the handles of mlcp.h. One file a handle; everything that needs no C stands in the Python modules."""
cimport numpy as cnp
from cpython.buffer cimport PyBUF_WRITABLE
from cpython.bytes cimport PyBytes_AS_STRING, PyBytes_FromStringAndSize
from libc.stddef cimport ptrdiff_t
from libc.stdint cimport INT32_MAX, int32_t, int64_t, uint8_t, uint64_t
from libc.string cimport memcpy
from posix.unistd cimport getpid

import os
import threading

import numpy as np
import scipy.sparse

from mlcp import errors, records, threads
from mlcp._abi cimport *

cnp.import_array()

if mlcp_abi_version() != MLCP_ABI_VERSION:
    raise ImportError(f"mlcp was built for ABI {MLCP_ABI_VERSION} and got a library of ABI {mlcp_abi_version()}")

version = mlcp_version().decode()

include "status.pxi"
include "arrays.pxi"
include "lent.pxi"
include "problem.pxi"
include "timestep.pxi"
include "mask.pxi"
include "result.pxi"
include "watch.pxi"
include "parallel.pxi"
include "settings.pxi"
include "solver.pxi"
include "bound.pxi"
include "snapshot.pxi"
include "scene.pxi"
