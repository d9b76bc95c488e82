import { expect, type Locator, type Page } from '@playwright/test';
import { toFront } from './tabs';

type Kind = 'Bit flip' | 'Late input' | 'Stuck input' | 'Corrupted result';

/** The panel of the disturbances: faults that a robust program must tolerate. */
export class Disturb {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane="disturb"]');
  }

  async show(): Promise<void> {
    await toFront(this.page.getByRole('tab', { name: 'Disturbances', exact: true }));
    await expect(this.pane).toBeVisible();
  }

  get list(): Locator {
    return this.page.getByRole('region', { name: 'Disturbances of this PLC' });
  }

  line(text: string | RegExp): Locator {
    return this.list.getByRole('listitem').filter({ hasText: text });
  }

  /** Why the disturbance was refused. */
  get refusal(): Locator {
    return this.pane.getByRole('alert');
  }

  get told(): Locator {
    return this.pane.getByRole('status');
  }

  get path(): Locator {
    return this.pane.getByRole('combobox', { name: 'Variable or address' });
  }

  field(name: string): Locator {
    return this.pane.getByLabel(name, { exact: true });
  }

  get button(): Locator {
    return this.pane.getByRole('button', { name: 'Disturb', exact: true });
  }

  async kind(kind: Kind): Promise<void> {
    await this.pane.getByText(kind, { exact: true }).click();
    await expect(this.pane.getByRole('radio', { name: kind })).toBeChecked();
  }

  async when(when: 'In the next scan' | 'In a scan' | 'At random'): Promise<void> {
    await this.field('When').selectOption(when);
  }

  async takeBack(text: string | RegExp): Promise<void> {
    await this.line(text)
      .getByRole('button', { name: /^Take back/ })
      .click();
  }
}
