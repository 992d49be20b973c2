"""From mlcp_status to exceptions."""

cdef dict exception_of = {
    MLCP_ERROR_NULL: errors.ArgumentError,
    MLCP_ERROR_ARGUMENT: errors.ArgumentError,
    MLCP_ERROR_RANGE: errors.RangeError,
    MLCP_ERROR_STATE: errors.StateError,
    MLCP_ERROR_OUT_OF_MEMORY: MemoryError,
    MLCP_ERROR_IO: errors.FileError,
    MLCP_ERROR_FORMAT: errors.FormatError,
    MLCP_ERROR_UNSUPPORTED: errors.UnsupportedError,
}


cdef int check(mlcp_status status, const char *text=b"") except -1:
    """text: the object's own words, "" where it has none."""
    if status == MLCP_OK:
        return 0
    cdef bytes message = text if text[0] else mlcp_status_text(status)
    raise exception_of.get(status, errors.InternalError)(message.decode("utf-8", "replace"))
