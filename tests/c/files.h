/* SPDX-License-Identifier: MIT OR Apache-2.0
 * Files for a while: where they go, under names that no other process has. */
#ifndef EMBOUND_TEST_FILES_H
#define EMBOUND_TEST_FILES_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef char file_path[512];

static UNUSED void temporary_path(file_path path, const char *name) {
  const char *directory = getenv("TMPDIR");
  if (directory == NULL || directory[0] == '\0') {
    directory = "/tmp";
  }
  if (snprintf(path, sizeof(file_path), "%s/embound-%ld-%s", directory, (long)getpid(), name) >= (int)sizeof(file_path)) {
    printf("TMPDIR is too long\n");
    exit(2);
  }
}

static UNUSED void write_file(const char *path, const void *bytes, size_t size) {
  FILE *file = fopen(path, "wb");
  int written = file != NULL && fwrite(bytes, 1, size, file) == size;
  if (file == NULL || fclose(file) != 0 || !written) {
    printf("%s cannot be written\n", path);
    exit(2);
  }
}

#endif
