// What a test includes besides; compiled once for the tests of all modules.
#pragma once

#include <gmock/gmock.h>

#include "ci/precompiled.h"
