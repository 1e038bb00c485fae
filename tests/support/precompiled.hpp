#pragma once
#include "../../src/precompiled.hpp"
#include "catch.hpp"
