#pragma once
// The look of the page, on screen and on paper, and its script: page.css and page.js, which the build makes texts of.

namespace zlg::report {

extern const char* const page_css;
extern const char* const page_js;

}  // namespace zlg::report
