#include "gallery.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "bottle_line.h"
#include "cascade.h"
#include "chain.h"
#include "gripper.h"
#include "linkage.h"
#include "pile.h"
#include "rope.h"
#include "rope_over_pegs.h"
#include "table.h"
#include "tower.h"
#include "wall.h"
#include "wall_of_boxes.h"

namespace scenes {
namespace {

using Made = std::unique_ptr<Scene>;

GripperDesign gripper_design(std::span<const Choice> design) {
  constexpr std::pair<const char*, double GripperDesign::*> numbers[] = {{"friction", &GripperDesign::friction},
                                                                         {"clearance", &GripperDesign::clearance},
                                                                         {"part_mass", &GripperDesign::part_mass},
                                                                         {"finger_mass", &GripperDesign::finger_mass}};
  GripperDesign made;
  for (const Choice& choice : design) {
    const auto* const found = std::find_if(std::begin(numbers), std::end(numbers), [&](const auto& number) { return choice.name == number.first; });
    if (found == std::end(numbers)) throw std::invalid_argument("the design of a gripper has no \"" + choice.name + "\"");
    made.*found->second = choice.value;
  }
  return made;
}

constexpr Exhibit exhibits[] = {
    {"gripper", "fingers", 8, {160, 2}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<Gripper>(size, seed); },
     [](std::int32_t size, unsigned seed, std::span<const Choice> design) -> Made {
       return std::make_unique<Gripper>(size, seed, gripper_design(design));
     }},
    {"cascade", "bodies", 100, {360, 4}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<Cascade>(size, seed); }},
    {"bottles", "bottles", 24, {800, 8, 320}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<BottleLine>(size, seed); }},
    {"linkage", "of one size", 1, {100}, [](std::int32_t, unsigned) -> Made { return std::make_unique<Linkage>(); }},
    {"table", "of one size", 1, {60}, [](std::int32_t, unsigned) -> Made { return std::make_unique<Table>(0.2, 0.1); }},
    {"rope_over_pegs", "links", 30, {120}, [](std::int32_t size, unsigned) -> Made { return std::make_unique<RopeOverPegs>(size); }},
    {"pile", "spheres", 100, {60}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<Pile>(size, seed); }},
    {"chain", "links", 30, {60}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<Chain>(size, true, 1.0, seed); }},
    {"rope", "links", 60, {60}, [](std::int32_t size, unsigned seed) -> Made { return std::make_unique<Rope>(size, seed); }},
    {"tower", "boxes", 10, {60}, [](std::int32_t size, unsigned) -> Made { return Made(new BoxStack(tower_scene(size))); }},
    {"wall", "bricks a course, and courses", 8, {60},
     [](std::int32_t size, unsigned) -> Made { return Made(new BoxStack(wall_scene(size, size))); }},
    {"wall_of_boxes", "boxes a course, and courses", 5, {120, 2}, [](std::int32_t size, unsigned) -> Made { return std::make_unique<WallOfBoxes>(size); }},
};

}  // namespace

std::span<const Exhibit> gallery() { return exhibits; }

std::unique_ptr<Scene> make_scene(std::string_view name, std::int32_t size, unsigned seed, std::span<const Choice> design) {
  if (size < 1) throw std::invalid_argument("size = " + std::to_string(size) + " is not positive");
  for (const Exhibit& exhibit : exhibits) {
    if (name != exhibit.name) continue;
    if (design.empty()) return exhibit.make(size, seed);
    if (!exhibit.make_to) throw std::invalid_argument("there is nothing to choose in the scene \"" + std::string(name) + "\"");
    return exhibit.make_to(size, seed, design);
  }
  throw std::invalid_argument("there is no scene \"" + std::string(name) + "\"");
}

}  // namespace scenes
