import { chooseTheme, themes, usePrefs } from "../../../store/page/prefs";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";
import { ModeSwitch } from "./ModeSwitch";
import { People } from "./People";
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
