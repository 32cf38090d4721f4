#pragma once
// The page of an answer, with the pictures that decide.

#include <zlg/choice/choose.hpp>
#include <zlg/report/page.hpp>

namespace zlg::choice {

// In one sentence.
[[nodiscard]] std::string verdict(const Requirement& requirement, const Answer& answer);

[[nodiscard]] report::Page choice_page(const Requirement& requirement, const Answer& answer);

}  // namespace zlg::choice
