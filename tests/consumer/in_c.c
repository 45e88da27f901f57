/* SPDX-License-Identifier: MIT */

/* A program in C that asks for what is wrong, and is told so. */

#include <goffer.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    goffer_error error;
    goffer_file* file = goffer_file_load("nothing", 7, GOFFER_VERIFY_EVERYTHING, 1, &error);
    printf("goffer %s: %s\n", goffer_version(), error.text);
    return file == NULL && strstr(error.text, "not a body file") != NULL ? 0 : 1;
}
