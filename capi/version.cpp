#include "mlcp.h"
#include "report/names.h"

int32_t mlcp_abi_version(void) { return MLCP_ABI_VERSION; }
const char* mlcp_version(void) { return MLCP_VERSION_STRING; }

const char* mlcp_status_text(mlcp_status status) { return mlcp::status_text(status); }
const char* mlcp_outcome_text(mlcp_outcome outcome) { return mlcp::outcome_text(outcome); }
const char* mlcp_method_text(mlcp_method method) { return mlcp::method_text(method); }
