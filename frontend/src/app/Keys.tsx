/** The page of keys: those of the window, and those that editor, timeline and tables have themselves. */
import { showKeys, useKeys } from "../store/page/palette";
import { type TextKey, t } from "../text";
import { Dialog } from "../ui/Dialog";
import { GROUPS, shownKeys } from "./commands";
import "./keys.css";

/** Keys that only have a meaning where the focus is. */
const WHERE: Record<string, readonly (readonly [string, TextKey])[]> = {
  editor: [
    ["F12", "keys.definition"],
    ["Ctrl+F12", "keys.implementations"],
    ["Shift+F12", "keys.references"],
    ["Ctrl+Alt+R", "cross.title"],
    ["Shift+Alt+H", "calls.title"],
    ["F2", "keys.rename"],
    ["Ctrl+Space", "keys.complete"],
    ["Ctrl+Shift+Space", "keys.parameters"],
    ["Ctrl+.", "keys.fix"],
    ["Shift+Alt+F", "keys.format"],
    ["Ctrl+Shift+O", "keys.symbol"],
    ["Ctrl+F", "keys.find"],
    ["Ctrl+H", "keys.replace"],
    ["Ctrl+/", "keys.comment"],
  ],
  drawing: [
    ["C / O", "keys.drawing.ladder"],
    ["W X B", "keys.drawing.branch"],
    ["F Shift+F", "keys.drawing.box"],
    ["! E", "keys.drawing.mode"],
    ["Enter F2", "keys.drawing.name"],
    ["Ctrl+F2", "keys.rename"],
    ["Shift+← ↑ ↓ →", "keys.drawing.more"],
    ["Ctrl+L Ctrl+Shift+A", "keys.drawing.all"],
    ["Del Backspace", "keys.drawing.delete"],
    ["Ctrl+I Ctrl+Shift+I", "keys.drawing.network"],
    ["Ctrl+/", "keys.drawing.off"],
    ["Ctrl+Alt+W", "keys.drawing.watch"],
    ["Ctrl+Alt+F", "keys.drawing.force"],
    ["Shift+F12", "keys.drawing.writer"],
    ["Ctrl+Alt+R", "cross.title"],
  ],
  timeline: [
    ["← →", "keys.scan"],
    ["PgUp PgDn", "keys.scans"],
    ["Home End", "keys.ends"],
    ["Ctrl+← Ctrl+→", "keys.marks"],
  ],
};

export function Keys() {
  const open = useKeys((keys) => keys.open);
  return open ? <Page /> : null;
}

function Page() {
  const close = () => showKeys(false);
  const window = Object.entries(GROUPS).map(([name, commands]) => ({
    title: t(`keys.group.${name as keyof typeof GROUPS}`),
    rows: commands.flatMap(({ keys, label }) => (keys === undefined ? [] : [[shownKeys(keys), label] as const])),
  }));
  const others = Object.entries(WHERE).map(([name, rows]) => ({ title: t(`keys.group.${name as "editor"}`), rows }));
  return (
    <Dialog
      title={t("command.keys")}
      about={t("keys.about")}
      width={860}
      onClose={close}
      footer={
        <button type="button" className="btn" onClick={close}>
          {t("close")}
        </button>
      }
    >
      <div className="keys">
        {[...window, ...others].map(({ title, rows }) => (
          <section key={title}>
            <h3>{title}</h3>
            <dl>
              {rows.map(([keys, label]) => (
                <div key={`${keys} ${label}`}>
                  <dt>{t(label)}</dt>
                  <dd>
                    <kbd>{keys}</kbd>
                  </dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </Dialog>
  );
}
