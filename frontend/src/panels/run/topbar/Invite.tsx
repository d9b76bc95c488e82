import { useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { inviteLink } from "../../../store/plc/invite";
import { t } from "../../../text";
import { CopyButton } from "../../../ui/CopyButton";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";

/** The address that lets somebody in, and what it gives. */
export function Invite({ onClose }: { onClose: () => void }) {
  const [link, setLink] = useState<{ address: string; host: string | null } | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  useEffect(() => {
    inviteLink()
      .then(setLink)
      .catch((error: unknown) => setRefused(messageOf(error)));
  }, []);
  return (
    <Dialog
      title={t("invite.title")}
      about={t("invite.about")}
      trouble={refused}
      width={560}
      onClose={onClose}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("close")}
          </button>
          <CopyButton
            label={t("invite.copy")}
            done={t("link.copied")}
            className="btn primary"
            text={() => link?.address ?? ""}
            disabled={link === null}
          />
        </>
      }
    >
      <label className="field">
        <span>{t("invite.address")}</span>
        <input className="inp mono" readOnly value={link?.address ?? ""} onFocus={({ target }) => target.select()} />
      </label>
      {link?.host && (
        <p className="hint st warning">
          <Icon name="warning" small />
          {t("invite.own", { host: link.host })}
        </p>
      )}
    </Dialog>
  );
}
