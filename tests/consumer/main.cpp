// SPDX-License-Identifier: MIT
#include "use_boxwood.hpp"

int main() { return use_boxwood() ? 0 : 1; }
