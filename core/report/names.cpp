#include "report/names.h"

namespace mlcp {

const char* status_text(mlcp_status status) {
  switch (status) {
    case MLCP_OK: return "ok";
    case MLCP_ERROR_NULL: return "NULL argument";
    case MLCP_ERROR_ARGUMENT: return "bad argument";
    case MLCP_ERROR_RANGE: return "out of range";
    case MLCP_ERROR_STATE: return "bad state";
    case MLCP_ERROR_OUT_OF_MEMORY: return "out of memory";
    case MLCP_ERROR_IO: return "input or output failed";
    case MLCP_ERROR_FORMAT: return "bad format";
    case MLCP_ERROR_UNSUPPORTED: return "not supported";
    case MLCP_ERROR_INTERNAL: return "internal error";
    default: return "unknown status";
  }
}

const char* outcome_text(mlcp_outcome outcome) {
  switch (outcome) {
    case MLCP_SOLVED: return "solved";
    case MLCP_ITERATION_LIMIT: return "iteration_limit";
    case MLCP_WORK_LIMIT: return "work_limit";
    case MLCP_TIME_LIMIT: return "time_limit";
    case MLCP_INTERRUPTED: return "interrupted";
    case MLCP_INFEASIBLE: return "infeasible";
    case MLCP_UNBOUNDED: return "unbounded";
    case MLCP_NOT_POSITIVE_DEFINITE: return "not_positive_definite";
    case MLCP_BAD_INPUT: return "bad_input";
    default: return "unknown";
  }
}

const char* method_text(mlcp_method method) {
  switch (method) {
    case MLCP_METHOD_AUTO: return "auto";
    case MLCP_METHOD_SIMPLEX: return "simplex";
    case MLCP_METHOD_NEWTON: return "newton";
    case MLCP_METHOD_PGS: return "pgs";
    default: return "unknown";
  }
}

}  // namespace mlcp
