#include "allocations.h"

#include <cstdlib>

#include "assembly.h"

namespace bench {
namespace {

void* count_and_reallocate(void* calls, void* block, std::size_t, std::size_t size) {
  ++*static_cast<std::int64_t*>(calls);
  return std::realloc(block, size);
}

void release(void*, void* block, std::size_t) { std::free(block); }

}  // namespace

std::int64_t allocations_of_known_step(const mlcp_problem* problem, const mlcp_settings& settings) {
  std::int64_t calls = 0;
  const mlcp_allocator counting{&calls, count_and_reallocate, release};
  const Assembly numbers(problem);
  const handles::Problem own = numbers.build(&counting);
  mlcp_solver* solver = nullptr;
  handles::check(mlcp_solver_create(&settings, &counting, &solver));
  const handles::Solver owner(solver);
  std::int64_t before = 0;
  for (int step = 0; step < 3; ++step) {  // the first analyzes; the second is the largest step there will be
    before = calls;
    numbers.refresh(own);
    handles::check(mlcp_solve(solver, own.get(), nullptr, nullptr, nullptr), owner);
  }
  return calls - before;
}

}  // namespace bench
