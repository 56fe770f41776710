// SPDX-License-Identifier: MIT
// Compiles only where headers of Boxwood can be included by short names.
#if __has_include(<error.hpp>) || __has_include(<shared/aabb.h>)
int main() {}
#else
#error "no header of Boxwood has a short name"
#endif
