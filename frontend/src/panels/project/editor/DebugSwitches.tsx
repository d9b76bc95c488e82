import { shareOf, sitesIn } from "../../../logic/debug/coverage";
import { grouped, percent } from "../../../logic/format/numbers";
import { setCoverage, useCoverage } from "../../../store/debug/coverage";
import { toggleInline, usePrefs } from "../../../store/page/prefs";
import { useBench } from "../../../store/plc/bench";
import { useOnline } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { Switch } from "../../../ui/Switch";

/** Switches above the text: values at the ends of lines (private), coverage (for everybody at the PLC). */
export function DebugSwitches({ path }: { path: string }) {
  const inline = usePrefs((prefs) => prefs.inline);
  const online = useOnline();
  return (
    <>
      <span className="debugswitch" title={t("debug.inline.hint")}>
        <Switch on={inline} onToggle={toggleInline}>
          <span className="words">{t("debug.inline")}</span>
        </Switch>
      </span>
      {online && <CoverageSwitch path={path} />}
    </>
  );
}

/** The same as entries of a menu, where there is no room for them. */
export function useSwitches(): MenuItem[] {
  const inline = usePrefs((prefs) => prefs.inline);
  const online = useOnline();
  const coverage = useCoverage((state) => state.coverage?.on ?? false);
  return [
    { label: t("debug.inline"), checked: inline, onSelect: toggleInline },
    ...(online ? [{ label: t("coverage.label"), checked: coverage, onSelect: () => void setCoverage(!coverage) }] : []),
  ];
}

function CoverageSwitch({ path }: { path: string }) {
  const coverage = useCoverage((state) => state.coverage);
  const instance = useBench((bench) => bench.instance?.id);
  const on = coverage?.on ?? false;
  const share = on ? shareOf(sitesIn(coverage, path)) : null;
  const facts = coverage && on ? { since: grouped(coverage.since_scan), scans: grouped(coverage.scans) } : null;
  return (
    <span className="debugswitch row tight" title={facts ? t("coverage.since", facts) : t("coverage.hint")}>
      <Switch on={on} onToggle={() => void setCoverage(!on)}>
        <span className="words">{t("coverage.label")}</span>
        {share !== null && <span className="mono"> {percent(share)}</span>}
      </Switch>
      {coverage && coverage.files.length > 0 && (
        <MenuButton
          label={t("coverage.more")}
          className="ib sm"
          items={() => [
            {
              label: t("coverage.export"),
              icon: "export",
              onSelect: () => window.open(`/api/instances/${instance}/coverage.lcov`, "_self"),
            },
            { label: t("coverage.reset"), icon: "refresh", onSelect: () => void setCoverage(on, true) },
          ]}
        >
          <Icon name="chev-d" small />
        </MenuButton>
      )}
    </span>
  );
}
