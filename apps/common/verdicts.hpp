// SPDX-License-Identifier: MIT
//
// What verdicts are called in JSON.
#pragma once

#include <fovea/decision/tolerance.hpp>

namespace fovea::apps {

inline const char* word_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::ok: return "ok";
        case Verdict::low: return "low";
        case Verdict::high: return "high";
        case Verdict::not_ok: return "not_ok";
        case Verdict::unmeasured: break;
    }
    return "unmeasured";
}

}  // namespace fovea::apps
