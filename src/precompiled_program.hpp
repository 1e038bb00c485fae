#pragma once
// Precompiled for the rooms that tell others what to do: what every stage includes.
#include "precompiled.hpp"

#include "stage/stage.hpp"
