#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "scene.h"

namespace scenes {

/// Which steps, of default_step each, make a film that shows what a scene does.
struct Film {
  std::int32_t steps;
  std::int32_t every = 1;  // a frame each so many steps
  std::int32_t from = 0;   // the first frame
};

/// A number of a scene that a designer chooses, by its name.
struct Choice {
  std::string name;
  double value;
};

/// A scene that can be asked for by name.
struct Exhibit {
  const char* name;
  const char* unit;           // what its size counts
  std::int32_t default_size;  // small enough to be stepped while somebody watches
  Film film;
  std::unique_ptr<Scene> (*make)(std::int32_t size, unsigned seed);
  /// nullptr: there is nothing to choose.
  std::unique_ptr<Scene> (*make_to)(std::int32_t size, unsigned seed, std::span<const Choice> design) = nullptr;
};

/// All of them; a new scene gets a line in gallery.cpp.
std::span<const Exhibit> gallery();

/// What is not chosen is as it is without a design.
/// fails: std::invalid_argument for a name that is not there, size < 1, or a design that cannot be made.
std::unique_ptr<Scene> make_scene(std::string_view name, std::int32_t size, unsigned seed = 1, std::span<const Choice> design = {});

}  // namespace scenes
