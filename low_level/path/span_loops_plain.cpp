// SPDX-License-Identifier: Apache-2.0
#include "low_level/path/plain_span_loops.h"

namespace lodesman {

const SpanLoops& span_loops() noexcept { return kPlainSpanLoops; }

}  // namespace lodesman
