#pragma once
// Precompiled headers that every stage includes.
#include "precompiled.hpp"

#include "stage/stage.hpp"
