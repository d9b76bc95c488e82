import { chooseTheme, themes, usePrefs } from "../../../store/page/prefs";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";
import { ModeSwitch } from "./ModeSwitch";
import { Picker } from "./Picker";
import { PlcState } from "./PlcState";
import { Readings } from "./Readings";
import { RunControls } from "./RunControls";

/** The strip along the top: project and PLC, the state of the PLC, and its controls. */
export function TopBar({ onResetLayout }: { onResetLayout: () => void }) {
  const theme = usePrefs((prefs) => prefs.theme);
  return (
    <header className="topbar" data-pane="topbar">
      <div className="brand" title="Scanbench">
        <Icon name="logo" />
        <h1 className="sr">Scanbench</h1>
      </div>
      <Picker />
      <ModeSwitch />
      <PlcState />
      <span className="vr" />
      <RunControls />
      <Readings />
      <span className="vr" />
      <People />
      <div className="row tight">
        <IconButton icon="layout" label={t("layout.reset")} onClick={onResetLayout} />
        <MenuButton
          label={t("theme.switch", { theme: t(`theme.${theme}`) })}
          className="ib"
          items={() =>
            themes.map((name) => ({
              label: t(`theme.${name}`),
              checked: name === theme,
              onSelect: () => chooseTheme(name),
            }))
          }
        >
          <Icon name="theme" />
        </MenuButton>
      </div>
    </header>
  );
}

function People() {
  const present = usePlc((plc) => plc.users);
  const you = usePlc((plc) => plc.you);
  // A person with two windows counts once.
  const users = [...new Map(present.map((user) => [user.name, user])).values()];
  const others = users.filter((user) => user.name !== you?.name);
  const names = others.map((user) => user.name).join(", ");
  return (
    <ul className="people" aria-label={t("people.here")}>
      {users.map((user) => {
        const me = user.name === you?.name;
        return (
          <li key={user.name} className={`avatar${me ? " me" : ""}`} title={me ? t("people.you", user) : user.name}>
            {user.initials}
          </li>
        );
      })}
      {others.length > 0 && (
        <li className="avatar more" title={t("people.more", { count: others.length, names })} aria-hidden="true">
          {`+${others.length}`}
        </li>
      )}
    </ul>
  );
}
