import { Component, type ReactNode } from "react";
import { messageOf } from "../logic/format/messageOf";
import { t } from "../text";
import { Icon } from "./Icon";

/** A fault of the page itself ends what is inside, and nothing around it. It is said, and what is inside can be shown again. */
export class Boundary extends Component<{ children: ReactNode }, { fault: string | null }> {
  override state = { fault: null };

  static getDerivedStateFromError(error: unknown) {
    return { fault: messageOf(error) };
  }

  override render() {
    const { fault } = this.state;
    if (fault === null) return this.props.children;
    return (
      <div className="lonely" role="alert">
        <Icon name="error" />
        <span>{t("boundary.fault", { message: fault })}</span>
        <button type="button" className="btn sm" onClick={() => this.setState({ fault: null })}>
          {t("boundary.again")}
        </button>
        <button type="button" className="btn sm" onClick={() => location.reload()}>
          {t("boundary.reload")}
        </button>
      </div>
    );
  }
}
