// The PNG decoder, for tests only: the program writes pictures and reads none.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
