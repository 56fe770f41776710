// SPDX-License-Identifier: MIT
#pragma once

bool use_boxwood();
