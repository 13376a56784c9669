#pragma once

#include "gl/context.h"

namespace isoglass::gl {

/// A GL 4.5 core context, with a window or without.
///
/// Made, used and destroyed by one thread, in which it is current all the while.
class CurrentContext {
  public:
    CurrentContext() = default;
    virtual ~CurrentContext() = default;
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

    virtual Context& context() = 0;
};

}  // namespace isoglass::gl
