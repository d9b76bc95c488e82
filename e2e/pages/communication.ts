import type { Locator, Page } from '@playwright/test';

/** The communication unit of the PLC. */
export class Communication {
  readonly pane: Locator;

  constructor(private readonly page: Page) {
    this.pane = page.locator('[data-pane=communication]');
  }

  async open(): Promise<void> {
    await this.page.keyboard.press('Control+Shift+P');
    await this.page.getByRole('combobox', { name: 'Commands' }).pressSequentially('communication unit');
    await this.page.getByRole('option', { name: 'Show the communication unit' }).click();
    await this.pane.waitFor();
  }

  /** A server, the plant, the broker, or the map. */
  part(name: string): Locator {
    return this.pane.getByRole('region', { name, exact: true });
  }
}
