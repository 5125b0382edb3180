#include "core/plain_numbers.hpp"

namespace chainreel {

PlainNumbers::PlainNumbers() : plain_{}, before_{} {
  const locale_t own = duplocale(uselocale(locale_t{}));
  plain_ = newlocale(LC_NUMERIC_MASK, "C", own);
  if (plain_ == locale_t{} && own != locale_t{}) freelocale(own);
  if (plain_ != locale_t{}) before_ = uselocale(plain_);
}

PlainNumbers::~PlainNumbers() {
  if (plain_ == locale_t{}) return;
  uselocale(before_);
  freelocale(plain_);
}

}  // namespace chainreel
