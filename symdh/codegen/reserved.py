"""Names that languages keep for themselves, and a generated program must not use.

They are written down rather than asked for, because the lists of a running tool change with its
version.
"""

from __future__ import annotations

import re

from symdh.codegen.names import words

#: Keywords of C99 to C23 and of C++98 to C++20.
_C_KEYWORDS = words(
    """
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t
    char8_t class co_await co_return co_yield compl concept const const_cast consteval constexpr
    constinit continue decltype default delete do double dynamic_cast else enum explicit export
    extern false float for friend goto if inline int long mutable namespace new noexcept not not_eq
    nullptr operator or or_eq private protected public register reinterpret_cast requires restrict
    return short signed sizeof static static_assert static_cast struct switch template this
    thread_local throw true try typedef typeid typename typeof typeof_unqual union unsigned using
    virtual void volatile wchar_t while xor xor_eq
    """
)

#: Macros of the standard headers, and those that compilers and systems define besides.
_C_MACROS = words(
    """
    BUFSIZ CHAR_BIT CLOCKS_PER_SEC DOMAIN FILENAME_MAX FOPEN_MAX HUGE HUGE_VAL HUGE_VALF HUGE_VALL
    I INFINITY MAXFLOAT NAN NDEBUG NULL OVERFLOW PI PLOSS RAND_MAX SING TLOSS TMP_MAX UNDERFLOW
    X_TLOSS assert bool complex errno far fortran huge i386 imaginary interface linux
    math_errhandling max min near noreturn offsetof pascal signgam small stderr stdin stdout sun
    unix vax
    """
)
_C_MACRO_FAMILIES = re.compile(
    r"E[A-Z0-9]\w*|(M|FP|DBL|FLT|LDBL|DECIMAL|MATH|SIG|LC|SEEK|ATOMIC)_\w*"
    r"|(U?INT\w*|S?CHAR|UCHAR|U?SHRT|U?LONG|U?LLONG|SIZE|PTRDIFF|WCHAR|WINT)_(MIN|MAX|C)"
    r"|(METH|PY|NPY)_\w*|Py[A-Z_]\w*"  # Python.h and NumPy stand before the header in an extension
)


def is_reserved_in_c(name: str) -> bool:
    """Tell whether C or C++ has a name: a keyword, or a macro of a header."""
    return name in _C_KEYWORDS or name in _C_MACROS or _C_MACRO_FAMILIES.fullmatch(name) is not None


#: Functions and types of the C library that share the global namespace with those of C++.
C_LIBRARY = words(
    """
    abort abs acos acosh aligned_alloc asctime asin asinh atan atan2 atanh atexit atof atoi atol
    atoll bsearch calloc cbrt ceil clearerr clock close copysign cos cosh ctime difftime div div_t
    dup environ erf erfc exit exp exp2 expm1 fabs fclose fdim feof ferror fflush fgetc fgets floor
    fma fmax fmin fmod fopen fork fprintf fputc fputs fread free freopen frexp fscanf fseek ftell
    fwrite gamma getc getchar getenv gets gmtime hypot ilogb index isalnum isalpha iscntrl isdigit
    isgraph islower isprint ispunct isspace isupper isxdigit j0 j1 jn kill labs ldexp ldiv lgamma
    link llabs lldiv llrint llround localtime log log10 log1p log2 logb longjmp lrint lround lseek
    malloc mblen mbstowcs mbtowc memchr memcmp memcpy memmove memset mktime modf nan nearbyint
    nextafter nice open pause perror pipe pow printf ptrdiff_t putc putchar puts qsort raise rand
    read realloc remainder remove remquo rename rewind rindex rint round scalbln scalbn scanf select
    setbuf setjmp setlocale setvbuf sin sinh size_t sleep sprintf sqrt srand sscanf strcat strchr
    strcmp strcoll strcpy strcspn strerror strftime strlen strncat strncmp strncpy strpbrk strrchr
    strspn strstr strtod strtof strtok strtol strtoul strxfrm swab sync system tan tanh tgamma time
    time_t tm tmpfile tmpnam tolower toupper trunc truncate ungetc unlink vprintf wait wait_t
    wcstombs wctomb write y0 y1 yn
    """
)
