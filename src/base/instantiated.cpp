// Instantiates the extern templates of precompiled.hpp.
#include <cstdint>
#include <string>
#include <vector>

template class std::basic_string<char>;
template class std::vector<std::string>;
template class std::vector<float>;
template class std::vector<double>;
template class std::vector<std::uint32_t>;
template class std::vector<std::uint8_t>;
template class std::vector<std::size_t>;
