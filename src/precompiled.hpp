#pragma once
// Precompiled: the standard and library headers that most files include.
#include "base/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

// What nearly every file uses of these is compiled once, in base/instantiated.cpp.
extern template class std::basic_string<char>;
extern template class std::vector<std::string>;
extern template class std::vector<float>;
extern template class std::vector<double>;
extern template class std::vector<std::uint32_t>;
extern template class std::vector<std::uint8_t>;
extern template class std::vector<std::size_t>;
