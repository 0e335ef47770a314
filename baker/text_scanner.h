/* SPDX-License-Identifier: MIT */
/*
 * Reads text files of lines and tokens, which is what the mesh formats share. Lines end with LF,
 * CR LF or CR; tokens are separated by blanks and tabs; '#' at the start of a token begins a
 * comment; a backslash at the very end of a line continues the line.
 */
#ifndef LIMNI_TEXT_SCANNER_H
#define LIMNI_TEXT_SCANNER_H

#include "context.h"

typedef struct limni_scanner {
    limni_context *context;
    const char *path; ///< names the file in errors
    const char *cursor;
    const char *end; ///< *end == '\0', the only zero in the text
    uint32_t line;   ///< of the cursor, from 1
    void *c_locale;  ///< a locale_t, a name that strict C11 headers do not declare
} limni_scanner;

/// Part of a line; not terminated. Size 0 stands for the end of the line.
typedef struct limni_token {
    const char *text;
    size_t size;
} limni_token;

/// Starts at the first line. Fails on bytes that no text has, and on 4 GiB and more: below that,
/// nothing that is counted in a file overflows 32 bits. After success, limni_scanner_close() is
/// due.
limn_bake_status limni_scanner_open(limni_scanner *scanner, limni_context *context,
                                    const char *path, const char *text, size_t size);
void limni_scanner_close(limni_scanner *scanner);

/// Moves to the next line that has a token, and gives the token; false at the end of the file. All
/// tokens of the previous line must have been read or skipped.
bool limni_scanner_next_line(limni_scanner *scanner, limni_token *first);

/// The next token of this line.
limni_token limni_scanner_next_token(limni_scanner *scanner);

/// Makes the token that was read last the next one again.
void limni_scanner_put_back(limni_scanner *scanner, limni_token token);

/// Skips what is left of this line.
void limni_scanner_skip_line(limni_scanner *scanner);

bool limni_token_is(limni_token token, const char *word);

/// Words that have been noted, so that each is noted once; but not the hundreds that a damaged file
/// has.
enum { LIMNI_WORD_LIST_SIZE = 8 };
typedef struct limni_word_list {
    limni_token words[LIMNI_WORD_LIST_SIZE]; ///< in the text
    uint32_t count;
} limni_word_list;

/// Whether the word was not there before, and there was room for it.
bool limni_word_list_add(limni_word_list *list, limni_token word);

/// How much of a token to show in a message, for "%.*s".
int limni_token_shown(limni_token token);

/// A finite decimal number, correctly rounded, whatever the locale. `noun` names it in errors.
limn_bake_status limni_scanner_number(const limni_scanner *scanner, limni_token token,
                                      const char *noun, float *value);

/// A sharpness: a number that is not negative, or infinity as C prints it, "inf" or "infinity".
limn_bake_status limni_scanner_sharpness(const limni_scanner *scanner, limni_token token,
                                         float *value);

/// Reads numbers up to the end of the line; at least `least`, at most `most`. The first three go
/// to `values` if it is not NULL. `noun` names what the line describes.
limn_bake_status limni_scanner_numbers(limni_scanner *scanner, const char *noun, uint32_t least,
                                       uint32_t most, float values[3]);

/// A whole number without a sign, below 2^32. `noun` names it in errors.
limn_bake_status limni_scanner_whole(const limni_scanner *scanner, limni_token token,
                                     const char *noun, uint32_t *value);

/// Reads the digits at *cursor, and moves it behind them; false if there are none. Values beyond
/// 32 bits give some value beyond 32 bits.
bool limni_parse_digits(const char **cursor, uint64_t *value);

/// Records the error "path:line: …" and returns LIMN_BAKE_BAD_INPUT.
limn_bake_status limni_scanner_fail(const limni_scanner *scanner, uint32_t line, const char *format,
                                    ...) LIMNI_PRINTF(3, 4);

#endif
