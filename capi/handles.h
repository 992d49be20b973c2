#pragma once
#include <cstddef>
#include <cstdio>
#include <new>

#include "assemble/mask.h"
#include "assemble/problem.h"
#include "contact_solver.h"
#include "memory/error.h"
#include "memory/memory.h"
#include "memory/small_blocks.h"
#include "report/failure_folder.h"

/// Text of the last failed call on a handle.
struct ErrorText {
  char text[sizeof mlcp::Error::text] = "";

  void set(const char* message) { std::snprintf(text, sizeof text, "%s", message); }
};

/// What an object allocates first, beside it: large blocks are what a tiny problem's time goes to.
template <std::size_t size>
struct Room {
  alignas(std::max_align_t) char bytes[size];
};

struct mlcp_problem {
  Room<6144> room;
  mlcp::SmallBlocks blocks;
  mlcp::Problem problem;
  ErrorText error;

  explicit mlcp_problem(const mlcp::Memory& memory) : blocks(memory, room.bytes), problem(memory, blocks.memory()) {}
  explicit mlcp_problem(const mlcp::Problem& other) : blocks(other.memory, room.bytes), problem(other, blocks.memory()) {}
};

struct mlcp_mask {
  mlcp::Mask mask;
  mlcp::CarryWorkspace work;
  ErrorText error;

  explicit mlcp_mask(const mlcp::Memory& memory) : mask(memory), work(memory) {}
};

struct mlcp_solver {
  Room<16384> room;
  mlcp::SmallBlocks blocks;
  mlcp::ContactSolver solver;
  mlcp_mask lent;  ///< what mlcp_solver_mask lends: the result's mask
  mlcp::FailureFolder failures;
  ErrorText error;

  mlcp_solver(const mlcp::Settings& settings, const mlcp::Memory& memory)
      : blocks(memory, room.bytes), solver(settings, blocks.memory()), lent(blocks.memory()), failures(blocks.memory()) {}
};

namespace mlcp {

/// A handle inside the caller's memory. fails: bad_alloc, and what the constructor throws.
template <class Handle, class... Arguments>
Handle* make_handle(const Memory& memory, const Arguments&... arguments) {
  void* block = memory.reallocate(nullptr, 0, sizeof(Handle));
  try {
    return new (block) Handle(arguments...);
  } catch (...) {
    memory.release(block, sizeof(Handle));
    throw;
  }
}

/// `memory` is a copy: the handle's own goes with it.
template <class Handle>
void free_handle(Handle* handle, const Memory memory) {
  handle->~Handle();
  memory.release(handle, sizeof(Handle));
}

/// The half of a pair of hooks is no allocator.
inline Memory memory_of(const mlcp_allocator* allocator) {
  if (allocator && !allocator->reallocate != !allocator->release)
    throw Error(MLCP_ERROR_NULL, "allocator has only one of reallocate and release");
  return Memory(allocator);
}

/// Runs a call and turns whatever it throws into a status; the text goes to `error` unless that is NULL.
template <class Call>
mlcp_status guard(ErrorText* error, Call call) noexcept {
  mlcp_status status = MLCP_ERROR_INTERNAL;
  const char* text = "a defect of the library";
  try {
    call();
    return MLCP_OK;
  } catch (const Error& e) {
    if (error) error->set(e.text);
    return e.status;
  } catch (const std::bad_alloc&) {
    status = MLCP_ERROR_OUT_OF_MEMORY;
    text = "the allocator has no more memory";
  } catch (...) {
  }
  if (error) error->set(text);
  return status;
}

/// A call on a handle that is not const and keeps the text.
template <class Handle, class Call>
mlcp_status edit(Handle* handle, Call call) noexcept {
  if (!handle) return MLCP_ERROR_NULL;
  return guard(&handle->error, [&] { call(*handle); });
}

/// A call on a const handle: no text.
template <class Handle, class Call>
mlcp_status look(const Handle* handle, Call call) noexcept {
  if (!handle) return MLCP_ERROR_NULL;
  return guard(nullptr, [&] { call(*handle); });
}

/// A call whose text goes to the caller, "" when it is done; cut to `size` bytes.
template <class Call>
mlcp_status tell(char* message, std::size_t size, Call call) noexcept {
  ErrorText error;
  const mlcp_status status = guard(&error, call);
  if (message) std::snprintf(message, size, "%s", error.text);
  return status;
}

inline void require(const void* pointer, const char* name) {
  if (!pointer) throw Error(MLCP_ERROR_NULL, "%s is NULL", name);
}

inline const Mask* mask_of(const mlcp_mask* handle) { return handle ? &handle->mask : nullptr; }

}  // namespace mlcp
