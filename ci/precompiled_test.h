// The same for tests.
#pragma once

#include <gmock/gmock.h>

#include "ci/precompiled.h"
