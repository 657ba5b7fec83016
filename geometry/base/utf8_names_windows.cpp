/// File names from UTF-8: libstdc++ gives them back as UTF-8 and takes them by the encoding of the C library,
/// which knows no UTF-8 on older systems. Within this program, a conversion of narrow letters to wide ones
/// reads UTF-8 as well: the linker takes this function in the place of the library's, which on Windows is
/// bound when a program is linked.

#include <codecvt>
#include <cwchar>
#include <locale>

namespace std {

codecvt_base::result codecvt<wchar_t, char, mbstate_t>::do_in(mbstate_t& state, const char* from,
                                                              const char* from_end, const char*& from_next,
                                                              wchar_t* to, wchar_t* to_end,
                                                              wchar_t*& to_next) const {
  static const codecvt_utf8_utf16<wchar_t> utf8;
  return utf8.in(state, from, from_end, from_next, to, to_end, to_next);
}

}  // namespace std
