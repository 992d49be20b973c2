#pragma once
#include <cstdint>
#include <vector>

#include "../vector.h"

namespace scenes {

/// Where two shapes a and b are nearest, in the world's frame.
struct ContactPoint {
  Point point;           // halfway between the surfaces, m
  Point normal;          // of length 1, from a to b
  double gap;            // m, negative where they overlap
  std::int32_t feature;  // names the same spot of the pair from step to step, 0 … 2¹² − 1
};

/// The same contact with a and b exchanged.
inline ContactPoint reversed(ContactPoint contact) {
  contact.normal = -1.0 * contact.normal;
  return contact;
}

}  // namespace scenes
