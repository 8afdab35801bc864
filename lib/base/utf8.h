// Bytes of texts in UTF-8.
#pragma once

namespace gainsmith {

/// Whether a byte is the second or a later one of a character of UTF-8. Columns count the others.
inline bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace gainsmith
