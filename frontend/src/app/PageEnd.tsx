import type { IDockviewHeaderActionsProps } from "dockview-react";
import { useEffect, useState } from "react";
import { t } from "../logic/text";
import { pageOf } from "../store/navigate";
import { IconButton } from "../ui/IconButton";

/** At the end of the tabs that a page is among: the whole dock for them, or the other panels back. */
export function PageEnd({ containerApi, panels, group }: IDockviewHeaderActionsProps) {
  const [wide, setWide] = useState(() => group.api.isMaximized());
  useEffect(() => {
    const change = containerApi.onDidMaximizedGroupChange(() => setWide(group.api.isMaximized()));
    return () => change.dispose();
  }, [containerApi, group]);
  if (!wide && !panels.some((panel) => pageOf(panel.id))) return null;
  return (
    <span className="pageend">
      <IconButton
        icon={wide ? "layout" : "fit"}
        label={t(wide ? "sweep.narrow" : "sweep.widen")}
        small
        onClick={() => (wide ? containerApi.exitMaximizedGroup() : group.api.maximize())}
      />
    </span>
  );
}
