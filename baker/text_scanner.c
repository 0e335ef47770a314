/* SPDX-License-Identifier: MIT */

#include "text_scanner.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

/// The length of the line end at c, 0 if there is none.
static size_t line_end_size(const char *c) {
    if (c[0] == '\r' && c[1] == '\n') return 2;
    return c[0] == '\r' || c[0] == '\n';
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool is_text(unsigned char byte) {
    if (byte < 0x20) return byte == '\t' || byte == '\n' || byte == '\r';
    return byte != 0x7f; /* bytes from 0x80 are letters in names and comments, in any encoding */
}

/// Checked once for the whole file, so that from here on a zero byte is the end of the text.
static limn_bake_status check_bytes(const limni_scanner *scanner) {
    const char *bad = scanner->cursor;
    while (bad < scanner->end && is_text((unsigned char)*bad)) {
        bad++;
    }
    if (bad == scanner->end) return LIMN_BAKE_OK;

    uint32_t line = 1;
    for (const char *c = scanner->cursor; c < bad; c++) {
        line += *c == '\n' || (*c == '\r' && c[1] != '\n');
    }
    return limni_scanner_fail(scanner, line, "byte 0x%02x does not belong in a text file",
                              (unsigned)(unsigned char)*bad);
}

limn_bake_status limni_scanner_open(limni_scanner *scanner, limni_context *context,
                                    const char *path, const char *text, size_t size) {
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    *scanner = (limni_scanner){
        .context = context, .path = path, .cursor = text, .end = text + size, .line = 1};
    if (size >= UINT32_MAX) {
        return limni_fail(context, LIMN_BAKE_BAD_INPUT, "%s: the file has 4 GiB or more", path);
    }
    if (strncmp(text, byte_order_mark, 3) == 0) scanner->cursor += 3;
    LIMNI_TRY(check_bytes(scanner));

    scanner->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!scanner->c_locale) {
        return limni_fail(context, LIMN_BAKE_MEMORY, "%s: out of memory", path);
    }
    return LIMN_BAKE_OK;
}

void limni_scanner_close(limni_scanner *scanner) {
    freelocale((locale_t)scanner->c_locale);
    scanner->c_locale = NULL;
}

static bool ends_token(const char *c) {
    switch (*c) {
    case ' ':
    case '\t':
    case '\n':
    case '\r':
    case '\0':
        return true;
    case '\\':
        return line_end_size(c + 1) > 0;
    default:
        return false;
    }
}

static void skip_blanks(limni_scanner *scanner) {
    const char *c = scanner->cursor;
    for (;;) {
        while (*c == ' ' || *c == '\t') {
            c++;
        }
        const size_t continuation = *c == '\\' ? line_end_size(c + 1) : 0;
        if (continuation == 0) break;
        c += 1 + continuation;
        scanner->line++;
    }
    scanner->cursor = c;
}

limni_token limni_scanner_next_token(limni_scanner *scanner) {
    skip_blanks(scanner);
    const char *c = scanner->cursor;
    if (*c == '#') {
        /* A backslash continues no comment: "# C:\models\" would swallow a line of the mesh. */
        c += strcspn(c, "\r\n");
        scanner->cursor = c;
    }
    while (!ends_token(c)) {
        c++;
    }
    const limni_token token = {scanner->cursor, (size_t)(c - scanner->cursor)};
    scanner->cursor = c;
    return token;
}

void limni_scanner_put_back(limni_scanner *scanner, limni_token token) {
    scanner->cursor = token.text; /* the line is the same: no token crosses a line end */
}

void limni_scanner_skip_line(limni_scanner *scanner) {
    while (limni_scanner_next_token(scanner).size > 0) {
    }
}

bool limni_scanner_next_line(limni_scanner *scanner, limni_token *first) {
    for (;;) {
        *first = limni_scanner_next_token(scanner);
        if (first->size > 0) return true;
        const size_t line_end = line_end_size(scanner->cursor);
        if (line_end == 0) return false;
        scanner->cursor += line_end;
        scanner->line++;
    }
}

bool limni_token_is(limni_token token, const char *word) {
    return strlen(word) == token.size && memcmp(token.text, word, token.size) == 0;
}

bool limni_word_list_add(limni_word_list *list, limni_token word) {
    for (uint32_t w = 0; w < list->count; w++) {
        const limni_token other = list->words[w];
        if (other.size == word.size && memcmp(other.text, word.text, word.size) == 0) return false;
    }
    if (list->count == LIMNI_WORD_LIST_SIZE) return false;
    list->words[list->count++] = word;
    return true;
}

int limni_token_shown(limni_token token) {
    const size_t limit = 40;
    if (token.size <= limit) return (int)token.size;
    size_t shown = limit;
    while (shown > 0 && ((unsigned char)token.text[shown] & 0xc0) == 0x80) {
        shown--; /* cut no UTF-8 letter in two */
    }
    return (int)shown;
}

static const char *skip_digits(const char *c) {
    while (is_digit(*c)) {
        c++;
    }
    return c;
}

/// Whether all of the token is a decimal number. Stricter than strtof(), which also reads
/// hexadecimal numbers and leaves what follows the number to its caller.
static bool is_decimal(limni_token token) {
    const char *c = token.text;
    if (*c == '+' || *c == '-') c++;
    const char *whole = c;
    c = skip_digits(c);
    ptrdiff_t digits = c - whole;
    if (*c == '.') {
        const char *fraction = ++c;
        c = skip_digits(c);
        digits += c - fraction;
    }
    if (digits == 0) return false;
    if (*c == 'e' || *c == 'E') {
        c++;
        if (*c == '+' || *c == '-') c++;
        if (!is_digit(*c)) return false;
        c = skip_digits(c);
    }
    return c == token.text + token.size;
}

/// Whether the token is what C libraries print for a value that is not finite: inf, -nan(ind) …
static bool is_non_finite_word(limni_token token) {
    static const char *const words[] = {"inf", "nan"};
    const size_t sign = token.text[0] == '+' || token.text[0] == '-';
    for (size_t word = 0; word < 2; word++) {
        size_t same = 0;
        while (same < 3 && (token.text[sign + same] | 0x20) == words[word][same]) {
            same++;
        }
        if (same == 3) return true;
    }
    return false;
}

limn_bake_status limni_scanner_number(const limni_scanner *scanner, limni_token token,
                                      const char *noun, float *value) {
    const bool decimal = is_decimal(token);
    if (decimal) {
        /* Set for this call only: the user's callbacks must not see a changed locale. */
        const locale_t previous = uselocale((locale_t)scanner->c_locale);
        *value = strtof(token.text, NULL);
        uselocale(previous);
        if (isfinite(*value)) return LIMN_BAKE_OK;
    }
    if (decimal || is_non_finite_word(token)) {
        return limni_scanner_fail(scanner, scanner->line, "%s is not finite: '%.*s'", noun,
                                  limni_token_shown(token), token.text);
    }
    return limni_scanner_fail(scanner, scanner->line, "'%.*s' is not a number",
                              limni_token_shown(token), token.text);
}

/// Infinity in any case, without tolower(), which asks the locale.
static bool is_infinity(limni_token token) {
    static const char word[] = "infinity";
    if (token.size != 3 && token.size != sizeof word - 1) return false;
    size_t same = 0;
    while (same < token.size && (token.text[same] | 0x20) == word[same]) {
        same++;
    }
    return same == token.size;
}

limn_bake_status limni_scanner_sharpness(const limni_scanner *scanner, limni_token token,
                                         float *value) {
    if (is_infinity(token)) {
        *value = INFINITY;
        return LIMN_BAKE_OK;
    }
    LIMNI_TRY(limni_scanner_number(scanner, token, "sharpness", value));
    if (*value < 0) {
        return limni_scanner_fail(scanner, scanner->line, "sharpness is negative: '%.*s'",
                                  limni_token_shown(token), token.text);
    }
    *value += 0.0f; /* -0 is 0 */
    return LIMN_BAKE_OK;
}

limn_bake_status limni_scanner_numbers(limni_scanner *scanner, const char *noun, uint32_t least,
                                       uint32_t most, float values[3]) {
    const uint32_t line = scanner->line;
    uint32_t count = 0;
    for (;;) {
        const limni_token token = limni_scanner_next_token(scanner);
        if (token.size == 0) break;
        float value = 0;
        LIMNI_TRY(limni_scanner_number(scanner, token, "coordinate", &value));
        if (values && count < 3) values[count] = value;
        count++;
    }
    const char *plural = count == 1 ? "" : "s";
    if (count >= least && count <= most) return LIMN_BAKE_OK;
    if (least == most) {
        return limni_scanner_fail(scanner, line, "%s has %u number%s; %u are expected", noun, count,
                                  plural, least);
    }
    return limni_scanner_fail(scanner, line, "%s has %u number%s; %u to %u are expected", noun,
                              count, plural, least, most);
}

bool limni_parse_digits(const char **cursor, uint64_t *value) {
    const char *c = *cursor;
    uint64_t sum = 0;
    for (; is_digit(*c); c++) {
        if (sum <= UINT32_MAX) sum = 10 * sum + (uint64_t)(*c - '0');
    }
    const bool any = c != *cursor;
    *cursor = c;
    *value = sum;
    return any;
}

limn_bake_status limni_scanner_whole(const limni_scanner *scanner, limni_token token,
                                     const char *noun, uint32_t *value) {
    const char *c = token.text;
    uint64_t digits = 0;
    if (!limni_parse_digits(&c, &digits) || c != token.text + token.size) {
        return limni_scanner_fail(scanner, scanner->line, "'%.*s' is not a valid %s",
                                  limni_token_shown(token), token.text, noun);
    }
    if (digits > UINT32_MAX) {
        return limni_scanner_fail(scanner, scanner->line, "%s %.*s is too large", noun,
                                  limni_token_shown(token), token.text);
    }
    *value = (uint32_t)digits;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_scanner_fail(const limni_scanner *scanner, uint32_t line, const char *format,
                                    ...) {
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return limni_fail(scanner->context, LIMN_BAKE_BAD_INPUT, "%s:%u: %s", scanner->path, line,
                      message);
}
