// The PNG decoder with which the tests look at files, apart from the program's own.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
