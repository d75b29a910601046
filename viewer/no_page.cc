#include "octupole/view/internal/page_template.h"

namespace octupole::internal {

extern const std::string_view* const kPageTemplate = nullptr;
extern const std::size_t kPageTemplateSize = 0;

}  // namespace octupole::internal
