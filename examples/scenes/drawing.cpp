#include "drawing.h"

#include "geometry/box_contacts.h"

namespace scenes {

Drawing::Corners corners(const Box& box, const Frame& frame) {
  Drawing::Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = frame.to_world(corner(box, i));
  return corners;
}

}  // namespace scenes
