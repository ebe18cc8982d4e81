/* Preloaded into the program (LD_PRELOAD): the calls that write files fail as they do on a full disk,
 * from the one on whose number is in NO_SPACE_FROM, if their file is below the directory in
 * NO_SPACE_UNDER. Calls are those that may need space: write, rename, mkdir, fsync, and open where it
 * may make a file. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int is_below(const char* path) {
  const char* under = getenv("NO_SPACE_UNDER");
  return under != NULL && strncmp(path, under, strlen(under)) == 0;
}

static int is_open_below(int file) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n < 0) return 0;
  path[n] = '\0';
  return is_below(path);
}

static int fails(int concerned) {
  static long n_calls = 0;
  const char* from = getenv("NO_SPACE_FROM");
  if (!concerned || from == NULL || ++n_calls < atol(from)) return 0;
  errno = ENOSPC;
  return 1;
}

ssize_t write(int file, const void* data, size_t n) {
  if (fails(is_open_below(file))) return -1;
  ssize_t (*next)(int, const void*, size_t) = dlsym(RTLD_NEXT, "write");
  return next(file, data, n);
}

int fsync(int file) {
  if (fails(is_open_below(file))) return -1;
  int (*next)(int) = dlsym(RTLD_NEXT, "fsync");
  return next(file);
}

int rename(const char* from, const char* to) {
  if (fails(is_below(to))) return -1;
  int (*next)(const char*, const char*) = dlsym(RTLD_NEXT, "rename");
  return next(from, to);
}

int mkdir(const char* path, mode_t mode) {
  if (fails(is_below(path))) return -1;
  int (*next)(const char*, mode_t) = dlsym(RTLD_NEXT, "mkdir");
  return next(path, mode);
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  if (fails((flags & O_CREAT) && is_below(path))) return -1;
  int (*next)(const char*, int, ...) = dlsym(RTLD_NEXT, "open");
  return next(path, flags, mode);
}
