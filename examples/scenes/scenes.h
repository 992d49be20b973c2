#pragma once
/// Scenes shared by tests, benchmarks and examples, on mlcp.h alone. Each is a class that steps, and a function that builds the
/// problem of one representative step.
#include "bottle_line.h"
#include "cascade.h"
#include "chain.h"
#include "gallery.h"
#include "gripper.h"
#include "pile.h"
#include "record.h"
#include "rope.h"
#include "tower.h"
#include "wall.h"
#include "wall_of_boxes.h"
