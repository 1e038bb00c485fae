# Cross compiling for 64-bit Windows: Debian's mingw-w64 with POSIX threads, and the libraries of
# packaging/linux/libraries.sh, in FACETMILL_LIBRARIES.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FACETMILL_LIBRARIES)
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(triplet x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${triplet}-gcc-posix)
set(CMAKE_CXX_COMPILER ${triplet}-g++-posix)
# The preprocessor of the resource compiler has no name of its own with POSIX threads.
set(CMAKE_RC_COMPILER ${triplet}-windres)
set(CMAKE_RC_FLAGS_INIT "--preprocessor=${triplet}-gcc-posix --preprocessor-arg=-E --preprocessor-arg=-xc-header --preprocessor-arg=-DRC_INVOKED")
set(CMAKE_FIND_ROOT_PATH ${FACETMILL_LIBRARIES} /usr/${triplet})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
# Windows 10: the oldest version with UTF-8 by manifest.
set(CMAKE_C_FLAGS_INIT -D_WIN32_WINNT=0x0A00)
set(CMAKE_CXX_FLAGS_INIT -D_WIN32_WINNT=0x0A00)
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -static)
endforeach()
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
