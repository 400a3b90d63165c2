#pragma once
#include <detent/body.h>
#include <detent/contact.h>
#include <detent/event.h>
#include <detent/joint.h>
#include <detent/mover.h>
#include <detent/numbers.h>
#include <detent/query.h>
#include <detent/sensor.h>
#include <detent/shape.h>
#include <detent/world.h>

/// @file
/// Includes what a game uses: worlds, bodies, shapes, joints, contacts, events, sensors, queries, movers and numbers.
