/* SPDX-License-Identifier: MIT */
#include "script.h"

#include "numbers.h"
#include <stdio.h>
#include <string.h>

enum { FRAMES_MAX = 100000 };

static const char *const names[] = {
#define NAME(key, code, name, help) name,
    VIEW_KEYS(NAME)
#undef NAME
};

/// Takes the first word off the text. False at its end, or where there is no room for it.
static bool take_word(const char **text, char word[VIEW_SCRIPT_WORD_MAX]) {
    const size_t length = strcspn(*text, ",");
    if (length == 0 || length >= VIEW_SCRIPT_WORD_MAX) return false;
    memcpy(word, *text, length);
    word[length] = '\0';
    *text += length + ((*text)[length] == ',');
    return true;
}

static bool find_key(const char *word, view_key *key) {
    for (int k = 0; k < VIEW_KEY_COUNT; k++) {
        *key = (view_key)k;
        if (strcmp(word, names[k]) == 0) return true;
    }
    return false;
}

bool view_script_check(const char *text) {
    char word[VIEW_SCRIPT_WORD_MAX];
    view_key key;
    uint32_t frames;
    while (take_word(&text, word)) {
        if (word[0] != '+' && !find_key(word, &key) &&
            !limni_parse_number(word, FRAMES_MAX, &frames))
            return false;
    }
    return *text == '\0';
}

view_script_event view_script_next(view_script *script) {
    view_script_event event = {0};
    char word[VIEW_SCRIPT_WORD_MAX];
    if (script->wait > 0 && --script->wait > 0) return event;
    if (!take_word(&script->rest, word)) {
        event.is_key = true;
        event.key = VIEW_KEY_CLOSE;
    } else if (word[0] == '+') {
        memcpy(event.dropped, word + 1, strlen(word));
    } else {
        event.is_key = find_key(word, &event.key);
        if (!event.is_key) limni_parse_number(word, FRAMES_MAX, &script->wait);
    }
    return event;
}
