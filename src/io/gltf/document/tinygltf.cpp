// The code of tinygltf. Debian's library is built without Draco, so it is compiled here, with Draco.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_ENABLE_DRACO
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
