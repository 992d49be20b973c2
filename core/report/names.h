#pragma once
#include "mlcp.h"

/// Texts of enumerators; static storage, never NULL.
namespace mlcp {

const char* status_text(mlcp_status status);
const char* outcome_text(mlcp_outcome outcome);
const char* method_text(mlcp_method method);

}  // namespace mlcp
