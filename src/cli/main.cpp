#include "cli/entry.hpp"

int main(int argc, char** argv) { return facetmill::cli::entry(argc, argv); }
