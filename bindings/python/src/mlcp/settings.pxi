"""Settings by name. A new field of mlcp_settings gets a line in both functions, in _core.pyi and in the docstring of Solver."""

cdef dict methods = {mlcp_method_text(i).decode(): i for i in (MLCP_METHOD_AUTO, MLCP_METHOD_SIMPLEX, MLCP_METHOD_NEWTON, MLCP_METHOD_PGS)}
cdef dict pivot_rules = {"dual": MLCP_PIVOT_DUAL, "printed": MLCP_PIVOT_PRINTED}
cdef dict refactorizations = {"when_needed": MLCP_REFACTORIZE_WHEN_NEEDED, "always": MLCP_REFACTORIZE_ALWAYS}
cdef dict impulse_choices = {"any": MLCP_IMPULSES_ANY, "least_norm": MLCP_IMPULSES_LEAST_NORM}


cdef int32_t choice(str name, object value, dict choices) except? -1:
    if value not in choices:
        raise errors.ArgumentError(f"{name} = {value!r} is not one of {', '.join(map(repr, choices))}")
    return choices[value]


cdef object chosen(int32_t value, dict choices):
    return next(name for name, number in choices.items() if number == value)


cdef int write_settings(mlcp_settings *settings, dict values) except -1:
    for name, value in values.items():
        if name == "method":
            settings.method = choice(name, value, methods)
        elif name == "pivot_rule":
            settings.pivot_rule = choice(name, value, pivot_rules)
        elif name == "refactorize":
            settings.refactorize = choice(name, value, refactorizations)
        elif name == "trace":
            settings.trace = bool(value)
        elif name == "tolerance":
            settings.tolerance = value
        elif name == "max_iterations":
            settings.max_iterations = value
        elif name == "max_work":
            settings.max_work = value
        elif name == "max_seconds":
            settings.max_seconds = value
        elif name == "impulses":
            settings.impulses = choice(name, value, impulse_choices)
        elif name == "canonical":
            settings.canonical = bool(value)
        elif name == "warm_start":
            settings.warm_start = bool(value)
        elif name == "num_threads":
            settings.num_threads = value
        elif name == "facets":
            settings.facets = value
        elif name == "max_shifts":
            settings.max_shifts = value
        else:
            raise TypeError(f"there is no setting {name!r}")
    return 0


cdef dict read_settings(const mlcp_settings *settings):
    return {
        "method": chosen(settings.method, methods),
        "pivot_rule": chosen(settings.pivot_rule, pivot_rules),
        "refactorize": chosen(settings.refactorize, refactorizations),
        "trace": settings.trace != 0,
        "tolerance": settings.tolerance,
        "max_iterations": settings.max_iterations,
        "max_work": settings.max_work,
        "max_seconds": settings.max_seconds,
        "impulses": chosen(settings.impulses, impulse_choices),
        "canonical": settings.canonical != 0,
        "warm_start": settings.warm_start != 0,
        "num_threads": settings.num_threads,
        "facets": settings.facets,
        "max_shifts": settings.max_shifts,
    }
