# mlcp_options: how everything here is compiled. Never -ffast-math, on no compile or link line: it would link a constructor that
# changes the caller's floating-point environment. Contraction is off so that every CPU gives the same bits.
add_library(mlcp_options INTERFACE)
target_compile_options(mlcp_options INTERFACE -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow)

if(MLCP_SANITIZE)
  target_compile_options(mlcp_options INTERFACE -fsanitize=${MLCP_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(mlcp_options INTERFACE -fsanitize=${MLCP_SANITIZE})
endif()

# mlcp_coverage: what core and capi are compiled with besides, and all that has them in it linked with; tests/checks/coverage reads it.
add_library(mlcp_coverage INTERFACE)
if(MLCP_COVERAGE)
  target_compile_options(mlcp_coverage INTERFACE --coverage -fprofile-update=atomic)
  link_libraries(--coverage)
endif()
