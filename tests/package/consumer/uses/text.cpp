// The module has no public header; other modules link it.
bool use_text() {
  return true;
}
