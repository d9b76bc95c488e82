// Before the first paint: the theme chosen last, else what the system prefers. A file of its own, so that a
// content security policy without inline scripts can be used.
(() => {
  let theme = null;
  try {
    theme = JSON.parse(localStorage.getItem("scanbench.prefs") ?? "{}").theme ?? null;
  } catch {
    // A broken entry is the same as none.
  }
  if (!["dark", "light", "contrast"].includes(theme)) {
    if (matchMedia("(prefers-contrast: more)").matches) theme = "contrast";
    else theme = matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
  }
  document.documentElement.dataset.theme = theme;
})();
