#pragma once

#include <cstddef>
#include <string_view>

namespace octupole::internal {

/// The page as viewer/ builds it, in pieces that compilers accept as literals; no pieces where it could not be built.
/// It has the words @TITLE@ and @SCENES@, in this order, where HTML and JSON go.
extern const std::string_view* const kPageTemplate;
extern const std::size_t kPageTemplateSize;

}  // namespace octupole::internal
